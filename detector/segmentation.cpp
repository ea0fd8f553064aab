// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "detector/segmentation.hpp"

#include "detector/ghost_filter.hpp"

namespace stairway::detect {

std::string SegmentationOptions::problem() const {
  for (const std::string& problem :
       {normals.problem(), region_growing.problem(), patches.problem(), split_and_merge.problem(), voxel_sac.problem()})
    if (!problem.empty()) return problem;
  if (!(min_grazing_rad >= 0.0 && min_grazing_rad < std::numbers::pi / 4))
    return "min_grazing must lie between 0 and 45 degrees";
  return {};
}

int SegmentationOptions::min_points() const {
  switch (method) {
    case SegmentationMethod::SplitAndMerge:
      return split_and_merge.min_points;
    case SegmentationMethod::VoxelSac:
      return voxel_sac.min_points;
    case SegmentationMethod::RegionGrowing:
      break;
  }
  return region_growing.min_points;
}

std::vector<PlaneRegion> segment(const scan::PointCloud& thinned, const SegmentationOptions& options,
                                 const StageListener& on_stage, int threads) {
  if (options.method == SegmentationMethod::SplitAndMerge) {
    begin_stage(on_stage, "segmentation");
    return split_and_merge(thinned, options.split_and_merge);
  }
  begin_stage(on_stage, "normals");
  SurfaceNormals surface = estimate_normals(thinned, thinned.points.size(), options.normals, threads);
  begin_stage(on_stage, "segmentation");
  scan::PointCloud clean = thinned;
  const std::vector<std::uint32_t> kept = drop_ghosts(clean, surface, options.min_grazing_rad);
  std::vector<PlaneRegion> regions = options.method == SegmentationMethod::VoxelSac
                                         ? voxel_sac(clean, surface, options.voxel_sac)
                                         : grow_regions(clean, surface, options.region_growing);
  for (PlaneRegion& region : regions)
    for (std::uint32_t& point : region.points) point = kept[point];
  return regions;
}

std::vector<PlaneRegion> segment_by_patches(const scan::PointCloud& cloud, double voxel_m,
                                            const SegmentationOptions& options, const StageListener& on_stage,
                                            int threads) {
  SurfaceElements elements = surface_elements(cloud, voxel_m, options.normals, options.patches, on_stage, threads);
  begin_stage(on_stage, "segmentation");
  elements.drop_ghosts(options.min_grazing_rad);
  return grow_regions(cloud, elements, options.region_growing, threads);
}

}  // namespace stairway::detect
