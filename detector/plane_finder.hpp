// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "detector/plane_region.hpp"
#include "detector/stair_part.hpp"
#include "scan_assembly/point_cloud.hpp"

namespace stairway::detect {

struct PlaneFinderOptions {
  double max_tilt_rad =
      std::numbers::pi / 12;  ///< normal against horizontal (riser) or vertical (tread) [rad]; the paper's 15 deg
  double max_riser_height_m = 0.24;  ///< vertical extent of a riser [m]; DIN 18065's 21 cm and a margin
  double max_tread_depth_m =
      0.40;                   ///< extent of a tread along its second eigenvector [m]; DIN 18065's 37 cm and a margin
  double min_width_m = 0.15;  ///< extent along the first eigenvector [m]; ours: narrower ones are posts and scraps

  bool find_edges = true;  ///< ours: also look for bars along the nosings and strips of treads below the floor
  double max_edge_thickness_m = 0.15;                ///< extent of an edge across its length, in depth and height [m]
  double min_edge_width_m = 0.40;                    ///< its extent along the first eigenvector [m]
  double max_edge_tilt_rad = std::numbers::pi / 18;  ///< its first eigenvector against horizontal [rad]

  std::string problem() const;
};

/// Tells whether one region looks like a riser or a tread of a step, looking at nothing but the region itself.
///
/// @param cloud  the segmented cloud, z up [m].
/// @return the part, or nothing. Cost: O(n log n) in the region's points.
/// Method: Westfechtel et al. 2018, section "Plane Finder".
std::optional<StairPart> find_stair_part(const scan::PointCloud& cloud, const PlaneRegion& region,
                                         const PlaneFinderOptions& options = {});

/// Tells whether a region is a horizontal bar, as the front of an open tread is where the beam's spot is as wide as the
/// tread is thick: its normal means nothing there, but its direction and place do.
/// Not in the paper, whose stairway I is lost for this reason beyond 4 m.
std::optional<StairPart> find_edge(const scan::PointCloud& cloud, const PlaneRegion& region,
                                   const PlaneFinderOptions& options = {});

}  // namespace stairway::detect
