// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <numbers>
#include <string>
#include <vector>

#include "detector/plane_finder.hpp"
#include "detector/plane_region.hpp"
#include "scan_assembly/point_cloud.hpp"

namespace stairway::detect {

struct FragmentMergingOptions {
  bool enabled = true;
  double max_offset_m = 0.025;                        ///< between two fragments, across their plane [m]
  double max_gap_m = 0.20;                            ///< between two fragments, in their plane [m]
  double max_riser_angle_rad = std::numbers::pi / 9;  ///< between the normals of two riser fragments [rad]

  std::string problem() const;
};

/// Joins regions that noise, dirt or a baluster has torn from one riser or tread.
///
/// Only regions that pass the plane finder (whatever their width) are joined, and only into ones that still do.
///
/// @return all regions, joined ones in the place of their first member.
/// Cost: O(F k) for F riser and tread shaped regions with k around each. Not in the paper; see docs/architecture.md.
std::vector<PlaneRegion> merge_fragments(const scan::PointCloud& cloud, std::vector<PlaneRegion> regions,
                                         const PlaneFinderOptions& plane_finder,
                                         const FragmentMergingOptions& options = {});

}  // namespace stairway::detect
