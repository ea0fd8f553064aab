// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "detector/stairway.hpp"
#include "scan_assembly/frames.hpp"
#include "tools/sim/furniture.hpp"
#include "tools/sim/mesh.hpp"
#include "tools/sim/stair_spec.hpp"

namespace stairway::sim {

/// Floor, four walls and ceiling around the robot, who stands at x = y = z = 0 and looks along x [m].
struct Room {
  Eigen::Vector2d low{-4.0, -4.0};
  Eigen::Vector2d high{8.0, 4.0};
  double height_m = 2.8;
};

/// The place of the robot on the floor, around x = y = 0, which nothing may cover.
Outline robot_outline();

/// What a scene consists of, before it is built.
struct SceneSpec {
  std::string name;
  Room room;
  std::vector<StairSpec> stairs;
  std::vector<Furniture> furniture;
  std::optional<scan::MountOptions> mount;  ///< of a scanner that can see the stairs, when not every one can

  /// First problem found, worded for the person who wrote the scene; empty when it can be built.
  std::string problem() const;
};

/// What the scanner can see, and what there is to find.
struct Scene {
  std::string name;
  Mesh mesh;                                ///< scene frame = `base` of a robot that stands level [m]
  std::vector<detect::Stairway> truths;     ///< in the order of the specification
  std::optional<scan::MountOptions> mount;  ///< as in the specification
  std::vector<StairSpec> stairs;            ///< likewise
};

/// Builds the meshes. A descending flight gets an opening in the floor with a shaft below it, and an ascending flight
/// that comes nearer to the ceiling than headroom allows one in the ceiling. Throws std::invalid_argument with
/// problem().
Scene build_scene(const SceneSpec& spec);

}  // namespace stairway::sim
