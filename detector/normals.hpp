// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "scan_assembly/point_cloud.hpp"

namespace stairway::detect {

struct NormalOptions {
  /// Neighbours within this distance make a normal [m], > 0. A fixed number of neighbours would span too little near
  /// the robot: with 10 mm of range noise the 24 nearest points of a 1 cm grid misjudge 59 % of the normals at 1 m.
  double radius_m = 0.06;
  int min_neighbours = 8;  ///< where the radius holds fewer points, it is doubled, up to three times [points], >= 3

  /// First problem found, worded for the person who set it; empty when usable.
  std::string problem() const;
};

/// One per point, in the order of the cloud.
struct SurfaceNormals {
  std::vector<Eigen::Vector3f> normals;  ///< unit length; facing the sensor when its place is known
  std::vector<float> variations;         ///< share of the neighbourhood's variance off the plane, in [0, 1/3]
};

/// Normals by principal component analysis over a metric neighbourhood.
///
/// Neighbours are summed up in cells a third of the radius wide, and all points of a cell share its normal:
/// neighbouring normals differ by less than their noise, and the work shrinks to that of the cells. Where the radius
/// holds too few points, the same is done again with cells and radius of twice the size.
///
/// @param cloud  finite points in any frame [m].
/// Cost: O(N); the neighbourhoods dominate.
/// Method: PCA as in the paper's preprocessing, which leaves the neighbourhood open.
SurfaceNormals estimate_normals(const scan::PointCloud& cloud, const NormalOptions& options = {});
/// The same for the first `wanted` points alone; the others only help to tell the normals of those.
SurfaceNormals estimate_normals(const scan::PointCloud& cloud, std::size_t wanted, const NormalOptions& options,
                                int threads = 1);

}  // namespace stairway::detect
