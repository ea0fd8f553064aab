// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "detector/segmentation.hpp"

namespace stairway::detect {

std::string SegmentationOptions::problem() const {
  for (const std::string& problem :
       {normals.problem(), region_growing.problem(), split_and_merge.problem(), voxel_sac.problem()})
    if (!problem.empty()) return problem;
  return {};
}

std::vector<PlaneRegion> segment(const scan::PointCloud& thinned, const SegmentationOptions& options,
                                 const StageListener& on_stage) {
  const auto begin_stage = [&](std::string_view stage) {
    if (on_stage) on_stage(stage);
  };
  if (options.method == SegmentationMethod::SplitAndMerge) {
    begin_stage("segmentation");
    return split_and_merge(thinned, options.split_and_merge);
  }
  begin_stage("normals");
  const SurfaceNormals surface = estimate_normals(thinned, options.normals);
  begin_stage("segmentation");
  return options.method == SegmentationMethod::VoxelSac ? voxel_sac(thinned, surface, options.voxel_sac)
                                                        : grow_regions(thinned, surface, options.region_growing);
}

}  // namespace stairway::detect
