// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "detector/stair_profile.hpp"

namespace stairway::detect {

/// How the sensor answers when its spot lies on more than one surface.
struct SpotOptions {
  double radius_rad = 6.65e-3;      ///< half the spot's full angle, >= 0
  double pulse_separation_m = 0.7;  ///< surfaces nearer to each other in range give one echo between them
};

/// What is seen past a flight next to some elevation: a plane, whose inverse range changes evenly with elevation.
struct Backdrop {
  double inverse_per_m = 0.0;  ///< 1 / range within the plane of the profile; NaN when nothing tells
  double slope_per_m = 0.0;    ///< of the inverse, per rad
  double elevation_rad = 0.0;  ///< at which it is that
  /// NaN when nothing tells.
  double range_m(double at_rad) const { return 1.0 / (inverse_per_m + slope_per_m * (at_rad - elevation_rad)); }
};

/// What one beam of a model measures.
struct SpotEcho {
  bool is_known = false;  ///< the spot lies on known faces, and it is certain which of them answer together
  bool is_mixed = false;  ///< on more than one
  bool is_past = false;   ///< it misses the flight
  double range_m = 0.0;   ///< of the echo of the larger part, within the plane of the profile
  double spread_m = 0.0;  ///< how far apart in range those lie that it is mixed of
  /// Where surfaces are too far apart for one echo: the share of the nearer ones, and the echo of either.
  bool is_split = false;
  double near_share = 1.0;
  double near_m = 0.0;
  double far_m = 0.0;
};

/// Share of an evenly lit unit disk that lies below a chord at x: 0 for x <= -1, 1 for x >= 1.
double share_below_chord(double x);

/// The echo of a beam at an elevation whose spot spreads over `spread_rad` to both sides.
///
/// The spot is an evenly lit disk: its share between two elevations follows from the area between two chords.
/// @param faces     visible_faces()
/// Cost: O(log n) in the faces.
SpotEcho echo_of(std::span<const VisibleFace> faces, const Elevation& at, double spread_rad, const Backdrop& backdrop,
                 double pulse_separation_m);

}  // namespace stairway::detect
