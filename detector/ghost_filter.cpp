// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "detector/ghost_filter.hpp"

#include <cmath>

namespace stairway::detect {

std::vector<std::uint32_t> drop_ghosts(scan::PointCloud& cloud, SurfaceNormals& surface, double min_grazing_rad) {
  const auto least_sine = static_cast<float>(std::sin(min_grazing_rad));
  const auto is_ghost = [&](std::size_t i) {
    if (!cloud.sensor_origin) return false;
    const Eigen::Vector3f sight = (cloud.points[i] - *cloud.sensor_origin).normalized();
    return std::abs(sight.dot(surface.normals[i])) < least_sine;
  };
  std::vector<std::uint32_t> kept;
  kept.reserve(cloud.points.size());
  for (std::size_t i = 0; i < cloud.points.size(); ++i)
    if (!is_ghost(i)) kept.push_back(static_cast<std::uint32_t>(i));
  for (std::size_t k = 0; k < kept.size(); ++k) {
    cloud.points[k] = cloud.points[kept[k]];
    surface.normals[k] = surface.normals[kept[k]];
    surface.variations[k] = surface.variations[kept[k]];
  }
  cloud.points.resize(kept.size());
  surface.normals.resize(kept.size());
  surface.variations.resize(kept.size());
  return kept;
}

}  // namespace stairway::detect
