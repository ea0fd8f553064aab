// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "tools/sim/scene.hpp"

namespace stairway::sim {

/// A scene that cannot be read. The text names file, line and key, and what is allowed there.
class SceneFileError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Reads a scene from TOML; tools/sim/scenes/straight-flight.toml shows every key.
///
/// Lengths end in `_m` and angles in `_deg`. A flight stands at `position_m`, or at `distance_m` and `bearing_deg` from
/// the robot, and without `heading_deg` it faces the robot. Keys that do not exist are refused.
/// @param source  what to call the text in errors.
/// Throws SceneFileError.
SceneSpec parse_scene(std::string_view text, const std::string& source);

/// Finds a scene by what a user calls it: the name of a shipped one ("straight-flight"), a path that ends in ".toml",
/// or a random one by its seed, as random_scene() knows it ("random-stairs:17"). Throws SceneFileError.
SceneSpec load_scene(const std::string& name);

/// What load_scene knows without a file, sorted.
std::vector<std::string> shipped_scene_names();

}  // namespace stairway::sim
