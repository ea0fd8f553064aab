// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <numbers>
#include <string>

#include "detector/stair_model.hpp"
#include "scan_assembly/point_cloud.hpp"

namespace stairway::detect {

struct RailingOptions {
  bool enabled = true;
  double max_side_distance_m = 0.15;   ///< of handrail and balusters from the end of the steps, within or beside [m]
  double min_handrail_height_m = 0.7;  ///< above the line of nosings [m]
  double max_handrail_height_m = 1.2;
  double max_handrail_angle_rad = std::numbers::pi / 18;  ///< against the line of nosings [rad]
  double max_baluster_angle_rad = std::numbers::pi / 12;  ///< against the vertical [rad]
  double max_thickness_m = 0.2;        ///< of a handrail or a baluster; what is thicker is a wall or a person [m]
  double min_handrail_length_m = 0.5;  ///< what must be seen of it [m]
  int min_balusters = 3;               ///< so many in a row are a railing without a handrail

  std::string problem() const;
};

/// On which sides of a stairway a railing is seen; left and right as seen while ascending.
struct Railing {
  bool left = false;
  bool right = false;
  double left_side_m = 0.0;   ///< where it runs, along left() from the middle line of the model [m]; 0 when not seen
  double right_side_m = 0.0;  ///< likewise
  bool any() const { return left || right; }
};

/// Looks for a handrail or a row of balusters beside a stairway.
///
/// A handrail is a thin bar along the line of nosings at hand height: its first eigenvector runs along the stairway and
/// there are few points above, below and inside of it. Outside of it there may be a wall: then it is mounted there. A
/// baluster is thin and upright, its first eigenvector near z, from knee to hand height. A wall, a person or a single
/// post are none.
///
/// @param cloud  frame of the model; what is not finite is left out.
/// @param sides  ends of the steps, along left() from the middle line of the model [m].
/// @param first, last  numbers of the lowest and the highest step.
/// Cost: one pass over the cloud.
/// Method: Westfechtel et al. 2018, section "Detection of the Railing System"; that a handrail alone will do and the
/// tests for what surrounds it are ours.
Railing find_railing(const scan::PointCloud& cloud, const StairModel& model, const Interval& sides, int first, int last,
                     const RailingOptions& options = {});

}  // namespace stairway::detect
