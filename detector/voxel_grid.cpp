// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "detector/voxel_grid.hpp"

namespace stairway::detect {

scan::PointCloud voxel_centroids(const scan::PointCloud& cloud, double leaf_m) {
  return centroids(cloud, group_by_cell(cloud.points, leaf_m));
}

scan::PointCloud centroids(const scan::PointCloud& cloud, const CellGroups& cells) {
  scan::PointCloud thinned;
  thinned.sensor_origin = cloud.sensor_origin;
  thinned.points.reserve(cells.size());
  for (std::size_t cell = 0; cell < cells.size(); ++cell) {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (const std::uint32_t i : cells[cell]) sum += cloud.points[i].cast<double>();
    thinned.points.push_back((sum / static_cast<double>(cells[cell].size())).cast<float>());
  }
  return thinned;
}

}  // namespace stairway::detect
