// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cmath>
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

/// An elevation within the plane of a profile with its cosine and sine, which are costly.
struct Elevation {
  double rad = 0.0;
  double cosine = 1.0;
  double sine = 0.0;

  Elevation(double at_rad) : rad(at_rad), cosine(std::cos(at_rad)), sine(std::sin(at_rad)) {}  // NOLINT: it is one
  /// Towards (u, z), `length_m` away.
  Elevation(double u, double z, double length_m) : rad(std::atan2(z, u)), cosine(u / length_m), sine(z / length_m) {}
  /// Another one, up to a tenth of a rad from this one to the last digits.
  Elevation near_by(double at_rad) const;
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
  double distance_m(const Elevation& at) const;
};

/// The faces that a sensor at `sensor` (u, z) sees, by rising elevation from -pi to pi without gaps.
/// Cost: O(n^2) in the nosings.
std::vector<VisibleFace> visible_faces(const StairProfileShape& shape, const Eigen::Vector2d& sensor);

}  // namespace stairway::detect
