// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <string_view>

#include "tools/sim/mesh.hpp"
#include "tools/sim/outline.hpp"

namespace stairway::sim {

/// What may stand in a room besides stairs; most of it has some property of a stairway.
enum class FurnitureKind {
  Box,        ///< closed on all sides
  Wall,       ///< a thin box, to hide things behind
  Column,     ///< round; size x is its diameter
  Table,      ///< top on four legs
  Chair,      ///< seat, legs and back
  Shelf,      ///< boards at equal heights between two sides, with a back
  Pallet,     ///< boards on three runners
  Bench,      ///< seat on two solid legs
  Radiator,   ///< a row of vertical ribs
  DoorFrame,  ///< two posts and a lintel
  DoorStep,   ///< a sill across a passage
  Ramp,       ///< rises along x over its whole length
  Bleachers,  ///< four high and deep steps that rise along x
  Platform,   ///< two steps and no more, rising along x
  Kerb,       ///< a raised pavement with one step along its whole side
  ChairRows,  ///< chairs one behind the other and side by side, all looking along x
};
inline constexpr std::size_t kFurnitureKinds = 16;

/// The name in scene files, e.g. "door-frame".
std::string_view to_string(FurnitureKind kind);
std::optional<FurnitureKind> furniture_kind(std::string_view name);
/// Length, width and height of a usual piece [m].
Eigen::Vector3d usual_size(FurnitureKind kind);

/// A piece on the floor, or on something: its middle, the turn of its own x axis, and the box that it fills.
struct Furniture {
  FurnitureKind kind = FurnitureKind::Box;
  Eigen::Vector2d position{0.0, 0.0};  ///< scene frame [m]
  double yaw_rad = 0.0;
  Eigen::Vector3d size{0.5, 0.5, 0.5};  ///< along its own axes [m], each above 0
  double level_m = 0.0;                 ///< what it stands on

  Outline footprint() const { return rectangle(position, size.head<2>(), yaw_rad); }
};

Mesh build_furniture(const Furniture& piece);

}  // namespace stairway::sim
