// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "detector/stairway.hpp"
#include "tools/sim/mesh.hpp"
#include "tools/sim/outline.hpp"

namespace stairway::sim {

/// One flight of stairs in the scene frame (`base` of a robot that stands level) [m, rad].
///
/// The number of nosings equals the number of risers: nosing 1 is the front edge of the first tread, one step height
/// above the lower floor, and nosing n the edge of the upper landing. A descending flight goes down from the floor z =
/// 0, whose edge is its nosing n.
struct StairSpec {
  int steps = 10;            ///< n, nosings and risers alike
  double height_m = 0.17;    ///< h, from tread to tread
  double depth_m = 0.29;     ///< d, from nosing to nosing; on a spiral the chord at mid width
  double width_m = 1.2;      ///< w
  bool open_risers = false;  ///< treads are boards on stringers (a column, on a spiral), one sees through below them
  double tread_thickness_m = 0.04;  ///< of the boards, and of the lip that an overhang forms on closed stairs
  double overhang_m = 0.0;          ///< how far a nosing stands out before the riser below it
  bool suspended = false;     ///< closed steps are a slab of even thickness, as spirals are, not solid to the floor
  bool railing_left = false;  ///< balusters and handrail, seen while ascending
  bool railing_right = false;
  double landing_m = 1.2;  ///< length of the landing at the far end
  bool descending = false;
  double level_m = 0.0;  ///< height of the floor where the robot meets the flight; above 0 behind a landing
  Eigen::Vector2d position{2.0,
                           0.0};   ///< middle of the nosing where the robot meets the flight: 1, or n when descending
  double heading_rad = 0.0;        ///< direction of ascent at that nosing, counter-clockwise from x
  double turn_per_step_rad = 0.0;  ///< positive when the ascent turns left; 0 is a straight flight
  std::vector<double>
      height_offsets_m;  ///< per nosing, lowest first: how far it lies above its regular place; may be empty
  std::vector<double>
      depth_offsets_m;  ///< per nosing: how far it lies beyond its regular place along the ascent; may be empty

  /// First problem found, worded for the person who wrote the numbers; empty when the flight can be built.
  std::string problem() const;
};

/// A flight as built, and what a perfect detector would say about it.
struct Flight {
  Mesh mesh;
  detect::Stairway truth;  ///< sigmas and score are 0; step height and depth are the regular ones
  Outline footprint;       ///< hull of the flight and its landing, seen from above
  double low_m = 0.0;      ///< the floor at its lower end
  double high_m = 0.0;     ///< the landing at its upper end
};

/// Throws std::invalid_argument with problem() when the flight cannot be built.
Flight build_flight(const StairSpec& spec);

/// The flight alone and in its own frame, as a CAD model would state it: going up along x, which begins at the first
/// nosing; y to the left, 0 at the middle of that nosing; z up from the floor at its foot [m]. Where the flight stands,
/// and whether one looks at it from above, makes no difference. Throws as build_flight() does.
Mesh flight_model(StairSpec spec);

}  // namespace stairway::sim
