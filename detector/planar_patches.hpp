// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "detector/normals.hpp"
#include "detector/plane_region.hpp"
#include "detector/region_growing.hpp"
#include "detector/stage_listener.hpp"
#include "scan_assembly/point_cloud.hpp"

namespace stairway::detect {

struct PatchOptions {
  bool enabled = true;
  double edge_m = 0.16;            ///< of the cells [m], > 0
  int min_points = 30;             ///< a patch has more points than this
  double max_thickness_m = 0.016;  ///< standard deviation of its points from their plane [m]

  std::string problem() const;
};

/// What a cloud is made of where regions are grown: patches, cells whose points lie on one plane without doubt, and
/// elsewhere single thinned points.
///
/// Most points of a building lie in the middle of floors, walls and steps, where nobody needs to ask each of them: a
/// sweep of 1.5 million points has some thousand patches, and a twentieth of its points are left for a closer look.
struct SurfaceElements {
  scan::PointCloud cloud;              ///< a point for every element, in the middle of those that it stands for
  SurfaceNormals surface;              ///< of the elements
  std::vector<std::uint32_t> weights;  ///< how many thinned points each stands for
  std::vector<std::uint32_t> members;  ///< points of the cloud, those of each element in a row
  struct Run {
    std::uint32_t first, last;  ///< in members
  };
  std::vector<Run> runs;  ///< of each element

  /// Drops elements whose surface is seen too flatly, see ghost_filter.hpp.
  void drop_ghosts(double min_grazing_rad);
};

/// A cell is a patch when its points fill it, lie on one plane but for strays, and the plane goes on in three of the
/// cells around it: columns have facets, and ghosts between two surfaces slopes, that would pass for planes else.
///
/// @param cloud    not thinned; points that are not finite belong to no element.
/// @param voxel_m  points that are in no patch are thinned to one in every cell of this edge [m], > 0.
/// @param on_stage  hears "voxel_grid" and "normals".
/// Independent of the number of threads, and of the order of the points but for the rounding of sums. Cost: O(N).
SurfaceElements surface_elements(const scan::PointCloud& cloud, double voxel_m, const NormalOptions& normals,
                                 const PatchOptions& options, const StageListener& on_stage = {}, int threads = 1);

/// The regions that grow over surface elements, each with all the points that its elements stand for.
/// @param elements  of this cloud.
std::vector<PlaneRegion> grow_regions(const scan::PointCloud& cloud, const SurfaceElements& elements,
                                      const RegionGrowingOptions& options, int threads = 1);

}  // namespace stairway::detect
