// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "detector/plane_region.hpp"

#include <utility>

namespace stairway::detect {

PlaneRegion make_region(std::span<const Eigen::Vector3f> cloud, std::vector<std::uint32_t> points,
                        const Eigen::Vector3d& facing) {
  PointMoments moments(cloud[points.front()].cast<double>());
  for (const std::uint32_t i : points) moments.add(cloud[i]);
  PlaneRegion region{std::move(points), principal_axes(moments)};
  if (region.axes.normal().dot(facing) < 0.0) region.axes.axes.col(2) *= -1.0;
  return region;
}

PlaneRegion make_region(const scan::PointCloud& cloud, std::vector<std::uint32_t> points) {
  const Eigen::Vector3f one = cloud.points[points.front()];
  const Eigen::Vector3f facing = cloud.sensor_origin.value_or(one) - one;
  return make_region(cloud.points, std::move(points), facing.cast<double>());
}

}  // namespace stairway::detect
