// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <numbers>
#include <string>
#include <vector>

#include "detector/normals.hpp"
#include "detector/plane_region.hpp"
#include "scan_assembly/point_cloud.hpp"

namespace stairway::detect {

/// The paper shows the sizes 16, 8 and 4 cm and gives no other figures. Beginning with 32 cm, and the other values too,
/// measured best on simulated flights (evaluate segmentation, seed 1000).
struct VoxelSacOptions {
  double max_leaf_m = 0.32;  ///< edge of the first cells [m], >= min_leaf_m; also about the widest gap that is spanned
  double min_leaf_m = 0.04;  ///< no smaller cells are tried [m], > 0
  int iterations = 20;       ///< planes through three random points that are tried in a cell, >= 1
  double min_inlier_share = 0.8;        ///< of the points of a cell that must lie in its plane, in (0, 1]
  double max_plane_distance_m = 0.025;  ///< point to plane, eq 1 [m], > 0
  double max_normal_angle_rad = std::numbers::pi / 7.2;  ///< normal of a point against the plane's [rad], in (0, pi/2)
  int min_cell_points = 3;  ///< k of Alg. 3: a region spreads on from a cell that gave it so many points, >= 1
  int min_points = 30;      ///< a region must have more points than this (the paper's 30)

  std::string problem() const;
};

/// Segments a cloud by RANSAC in the cells of ever finer grids; each plane found spreads over the adjacent cells.
///
/// Alg. 3 asks that all points of a cell comply with its plane, the text for a high share of them: the text is
/// followed. A region that stays too small gives its points back to the finer grids. Random numbers are seeded by the
/// number of the cell, so the same cloud gives the same regions.
///
/// @param cloud    finite points [m].
/// @param surface  from estimate_normals(), in the order of `cloud`.
/// @return regions in the order in which they were found, large cells first.
/// Cost: O(N (iterations + 27)) per cell size at most.
/// Method: Westfechtel et al. 2018, Alg. 3, eq 1.
std::vector<PlaneRegion> voxel_sac(const scan::PointCloud& cloud, const SurfaceNormals& surface,
                                   const VoxelSacOptions& options = {});

}  // namespace stairway::detect
