// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <numbers>
#include <string>
#include <vector>

#include "detector/normals.hpp"
#include "detector/planar_patches.hpp"
#include "detector/plane_region.hpp"
#include "detector/region_growing.hpp"
#include "detector/split_and_merge.hpp"
#include "detector/stage_listener.hpp"
#include "detector/voxel_sac.hpp"
#include "scan_assembly/point_cloud.hpp"

namespace stairway::detect {

/// The three ways of the paper to find planar regions.
enum class SegmentationMethod {
  RegionGrowing,  ///< Alg. 1; in the paper the most accurate one, and chosen for the detection
  SplitAndMerge,  ///< Alg. 2; the fastest one, as it needs no normals
  VoxelSac,       ///< Alg. 3
};

struct SegmentationOptions {
  SegmentationMethod method = SegmentationMethod::RegionGrowing;
  NormalOptions normals;  ///< for region growing and VoxelSAC
  /// Likewise: surfaces seen at less than this from within them are ghosts of two others; 0 keeps all. The paper's
  /// program takes 5 degrees; 10 separate more treads of a descent and cost nothing else that was measured.
  double min_grazing_rad = std::numbers::pi / 18;
  RegionGrowingOptions region_growing;
  PatchOptions patches;  ///< for region growing
  SplitAndMergeOptions split_and_merge;
  VoxelSacOptions voxel_sac;

  /// First problem found, worded for the person who set it; empty when usable.
  std::string problem() const;

  /// A region of the chosen method has more points than this.
  int min_points() const;
  /// Whether regions grow over patches, so that the cloud need not be thinned.
  bool uses_patches() const { return method == SegmentationMethod::RegionGrowing && patches.enabled; }
};

/// Splits a thinned cloud into planar regions.
///
/// @param thinned   finite points of any frame, about one per cm^3 [m].
/// @param on_stage  hears "normals", where the method needs them, and "segmentation".
/// @return regions with the indices of their points, every point in at most one; their normals face the sensor where
/// its place is known; whatever the number of threads, the same.
std::vector<PlaneRegion> segment(const scan::PointCloud& thinned, const SegmentationOptions& options = {},
                                 const StageListener& on_stage = {}, int threads = 1);

/// Grows regions over patches: as accurate as region growing, and faster by the share of the points that lie in
/// patches.
/// @param cloud    not thinned [m].
/// @param voxel_m  to which the points in no patch are thinned [m], > 0.
/// @return as segment(), with all points of the cloud that belong to a region.
std::vector<PlaneRegion> segment_by_patches(const scan::PointCloud& cloud, double voxel_m,
                                            const SegmentationOptions& options, const StageListener& on_stage = {},
                                            int threads = 1);

}  // namespace stairway::detect
