// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>

#include "detector/spot.hpp"
#include "detector/stair_corridor.hpp"
#include "detector/step_measurement.hpp"

namespace stairway::detect {

struct FlightEnds {
  std::optional<Estimate> right;  ///< v, along left() of the frame [m]
  std::optional<Estimate> left;   ///< likewise
};

/// Where a straight flight ends to both sides, from the beams of all its steps at once.
///
/// A beam whose elevation meets the flight either ends where the profile says, or passes its end and goes farther; one
/// that ends nearer met something else (a baluster, a person) and says nothing, unless that stands beyond the end. The
/// end is where the spot would have to be cut to explain best how far the beams went.
/// @param frame    of the flight's lowest step.
/// @param sensor   in its axes.
/// @param faces    visible_faces() of the flight from there; Beyond and Unknown ones are left out.
/// @param sides    about where the ends are; they are looked for from their middle to 0.6 m beyond.
/// @param floor_step  level faces of this step are a floor, which goes on beyond the flight; -1 for none.
/// @return nothing for an end that too few beams pass on either side.
/// Cost: O(n log n) in the points of the corridor.
FlightEnds find_flight_ends(const StairCorridor& corridor, const StepFrame& frame, const StepPoint& sensor,
                            std::span<const VisibleFace> faces, const Interval& sides, const SpotOptions& spot,
                            double range_sigma_m, int floor_step = -1);

}  // namespace stairway::detect
