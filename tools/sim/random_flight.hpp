// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tools/sim/random.hpp"
#include "tools/sim/stair_spec.hpp"

namespace stairway::sim {

/// Steps as people walk them: 140 to 200 mm by 240 to 340 mm, twice the height and the depth together 0.58 to 0.70 m.
void draw_usual_steps(StairSpec& flight, Random& random);

/// How a straight flight looks apart from its steps, width and risers: boards of 30 to 60 mm, an overhang of up to 30
/// mm half of the time, a railing on either side every third time, a landing of 0.8 to 1.6 m.
void draw_fittings(StairSpec& flight, Random& random);

/// Puts the first nosing of an ascending flight `nearest_m` to `farthest_m` from the robot in any direction and up to
/// 40 degrees askew, where no part of the flight reaches into robot_space().
void place_before_robot(StairSpec& flight, double nearest_m, double farthest_m, Random& random);

}  // namespace stairway::sim
