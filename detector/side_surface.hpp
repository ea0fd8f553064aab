// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>

#include "detector/step_measurement.hpp"

namespace stairway::detect {

/// A beam towards one side of a flight. Places grow outwards [m].
struct SideSight {
  double crossing_m = 0.0;  ///< where it would meet the face of its step
  double ended_m = 0.0;     ///< where it ended
  double farther_m = 0.0;   ///< than that face it went; negative when something stopped it before
};

/// The upright surface at which a flight ends, where it shows one: a wall beside it, or its own flank.
///
/// Beams past the end of a face then end on one plane: on a wall before they reach the level of the face, on a flank
/// behind it. Next to the end both are as near as if they had ended on the face itself. Posts and balusters stop only
/// some of the beams and are no surface.
/// @param about_m  about where the flight ends; it is looked for within 0.1 m.
/// @param reach_m  a beam ended on a face when it went no farther beyond it than this; > 0.
/// @return its place, grows outwards. Cost: O(n log n).
std::optional<Estimate> find_side_surface(std::span<const SideSight> sights, double about_m, double reach_m);

}  // namespace stairway::detect
