// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "tools/sim/scene.hpp"

namespace stairway::sim {

/// A furnished room with one straight ascending flight that a person would walk up: 4 to 12 steps of 140 to 200 mm by
/// 240 to 340 mm, twice the height and the depth together 0.58 to 0.70 m; 0.8 to 1.6 m wide; its first nosing 0.6 to 4
/// m from the robot in any direction and up to 40 degrees askew. Risers open or closed, overhang up to 30 mm, railings
/// now and then. Nothing stands on the flight or between it and the robot. The same seed gives the same scene on every
/// machine.
SceneSpec random_stair_scene(std::uint64_t seed);

/// A room without stairs, full of things that have something in common with them: shelves, stacked boxes, benches,
/// ramps, bleachers with steps of 400 mm, platforms of two steps.
SceneSpec random_room(std::uint64_t seed);

}  // namespace stairway::sim
