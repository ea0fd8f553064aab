// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "tools/sim/furniture.hpp"
#include "tools/sim/outline.hpp"
#include "tools/sim/random.hpp"
#include "tools/sim/scene.hpp"

namespace stairway::sim {

/// The square of 0.9 m around the robot that stairs and furniture leave free.
Outline robot_space();

/// What may stand around stairs without looking like more of them.
std::span<const FurnitureKind> clutter();

/// Any direction, a multiple of a right angle half of the time, as most things in rooms are [rad].
double random_yaw(Random& random);

/// A room that holds the robot and `outline` with 0.6 to 3 m to spare on every side, 2.5 to 3.4 m high.
Room room_around(const Outline& outline, Random& random);

/// Puts up to `pieces` things of `kinds` on the floor of `room`, each clear of `taken` and of the others; a thing that
/// finds no place in 20 attempts stays out. Boxes may be stacked.
std::vector<Furniture> furnish(const Room& room, std::span<const FurnitureKind> kinds, int pieces,
                               std::vector<Outline> taken, Random& random);

/// The same around stairs: 3 to 12 things, none of them on the flights or between them and the robot.
std::vector<Furniture> furnish_around(const Room& room, const std::vector<Outline>& footprints, Random& random);

/// Puts a room around the stairs of `spec` and furnishes it.
void surround(SceneSpec& spec, Random& random);

}  // namespace stairway::sim
