// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <numbers>
#include <string>
#include <vector>

#include "detector/plane_region.hpp"
#include "scan_assembly/point_cloud.hpp"

namespace stairway::detect {

/// The paper gives no figures. Sizes halve from the largest to the smallest one, whose doubles they are; the limits are
/// those that measured best on simulated flights (evaluate segmentation, seed 1000).
struct SplitAndMergeOptions {
  double max_leaf_m = 0.32;            ///< edge of the first cells [m], >= min_leaf_m
  double min_leaf_m = 0.04;            ///< no cell is split to smaller ones [m], > 0
  int min_leaf_points = 5;             ///< fewer points in a cell tell no plane [points], >= 3
  double max_leaf_distance_m = 0.035;  ///< all points of a cell must lie nearer to its plane [m], > 0
  /// Normal of a cell against the region's [rad], in (0, pi/2): the normals of small cells are noisy.
  double max_normal_angle_rad = std::numbers::pi / 6;
  double max_plane_distance_m = 0.03;  ///< middle of a cell to the region's plane, eq 1 [m], > 0
  int min_points = 30;                 ///< a region must have more points than this (the paper's 30)

  std::string problem() const;
};

/// Segments a cloud by splitting it into ever finer cells until the points of each lie in a plane, then merging
/// adjacent cells whose planes agree.
///
/// As the loop of Alg. 2 is printed, cells of the smallest size would be left out; here they are taken. Where the paper
/// merges cells pairwise, this merges a cell into the region that has grown so far, whose plane is updated with it:
/// otherwise regions creep around bends. Regions begin with the largest cells, the flattest first. Cells are adjacent
/// when they touch, whatever their sizes. Normals of points are not needed.
///
/// @param cloud  finite points [m].
/// @return regions in the order of their first cells.
/// Cost: O(N) per cell size and O(L log L) for the L cells.
/// Method: Westfechtel et al. 2018, Alg. 2, eq 1.
std::vector<PlaneRegion> split_and_merge(const scan::PointCloud& cloud, const SplitAndMergeOptions& options = {});

}  // namespace stairway::detect
