// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <vector>

#include "detector/stair_model.hpp"

namespace stairway::detect {

/// What a straight flight looks like in its vertical plane of ascent: u along the ascent, z up [m].
struct StairProfileShape {
  std::vector<Eigen::Vector2d> nosings;  ///< (u, z), lowest first, at least one
  double overhang_m = 0.0;               ///< of the nosings before the risers, >= 0
  double thickness_m = 0.04;             ///< of the treads' lips or, with open risers, of the treads, > 0
  bool open_risers = false;              ///< one looks through between the treads
  double step_height_m = 0.17;           ///< how far the lowest riser is taken to go down
  double last_tread_m = 0.0;             ///< how far the highest tread is known to go on
  bool goes_on_below = false;  ///< what one sees past the lowest nosing are further steps: unknown, not past the flight
};

/// A part of the profile that the sensor sees between two elevations.
struct VisibleFace {
  enum class Kind {
    Upright,  ///< riser, lip or front of a board, at u = `place_m`
    Level,    ///< tread or underside, at z = `place_m`
    Beyond,   ///< one looks past the flight
    Unknown,  ///< nothing is known about what is there: below the lowest riser, behind boards
  };
  double begin_rad = 0.0;  ///< elevation atan2(dz, du) at which it begins
  double end_rad = 0.0;    ///< and at which it ends, >= begin_rad
  Kind kind = Kind::Beyond;
  double place_m = 0.0;  ///< u or z, relative to the sensor
  int step = 0;          ///< index of the nosing it belongs to; for Beyond that of the edge below it

  /// Distance from the sensor within the plane, at an elevation on it. @pre Upright or Level.
  double distance_m(double elevation_rad) const;
};

/// The faces that a sensor at `sensor` (u, z) sees, by rising elevation from -pi to pi without gaps.
/// Cost: O(n^2) in the nosings.
std::vector<VisibleFace> visible_faces(const StairProfileShape& shape, const Eigen::Vector2d& sensor);

}  // namespace stairway::detect
