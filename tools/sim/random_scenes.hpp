// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "tools/sim/scene.hpp"

namespace stairway::sim {

/// A furnished room with one straight ascending flight that a person would walk up: 4 to 12 steps of 140 to 200 mm by
/// 240 to 340 mm, twice the height and the depth together 0.58 to 0.70 m; 0.8 to 1.6 m wide; its first nosing 0.6 to 4
/// m from the robot in any direction and up to 40 degrees askew. Risers open or closed, overhang up to 30 mm, railings
/// now and then. Nothing stands on the flight or between it and the robot. The same seed gives the same scene on every
/// machine.
SceneSpec random_stair_scene(std::uint64_t seed);

/// A furnished room with one ascending spiral that a person would build around a column: 8 to 14 steps that turn by 12
/// to 36 degrees each, left or right, and by one turn in all at most; 150 to 210 mm high and 200 to 300 mm deep at mid
/// width, twice the height and the depth together 0.56 to 0.68 m; 0.7 to 1.2 m wide; risers open or closed; what passes
/// over the first steps leaves 2 m. The robot stands 0.8 to 3 m before the first nosing, up to 40 degrees askew.
SceneSpec random_spiral_scene(std::uint64_t seed);

/// A furnished room whose robot stands at the upper edge of a straight flight going down, 0.25 to 0.7 m before it and
/// up to 25 degrees askew. `mount` is set: half of the scenes suit the inverted mount (scan plane pitched by -60
/// degrees; 5 to 10 usual steps), the other half the upright one.
///
/// From 0.5 m the upright scanner sees the floor only beyond 0.64 m, and a nosing j steps below the edge only where
/// j (d tan 37.8 deg - h) reaches 0.5 m - e tan 37.8 deg, e the distance of the edge. Its flights are therefore shallow
/// (360 to 400 mm by a slope of 20.5 to 23 degrees) and long (9 to 14 steps); nosings come into view from the second to
/// fourth on.
SceneSpec random_descending_scene(std::uint64_t seed);

/// The same for the inverted mount alone.
SceneSpec random_inverted_descending_scene(std::uint64_t seed);

/// A furnished room on the way between two storeys: one flight up and one down from the floor of the robot, side by
/// side or in different directions; the upper edge of the second is 0.3 to 0.7 m away, and `mount` is the inverted one,
/// which sees both. stairs[0] is the one that goes up.
SceneSpec random_mid_landing_scene(std::uint64_t seed);

/// A room without stairs, full of things that have something in common with them: shelves, stacked boxes, benches,
/// rows of chairs, tables, pallets, radiators, door steps, kerbs, ramps, bleachers with steps of 400 mm, platforms of
/// two steps.
SceneSpec random_room(std::uint64_t seed);

/// One of the above by its name and seed, e.g. "random-spiral:17"; empty when the name is none of them.
std::optional<SceneSpec> random_scene(std::string_view name);

/// The names that random_scene() knows, without seed.
std::vector<std::string_view> random_scene_kinds();

}  // namespace stairway::sim
