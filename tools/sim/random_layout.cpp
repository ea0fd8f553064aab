// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "tools/sim/random_layout.hpp"

#include <algorithm>
#include <array>
#include <numbers>
#include <optional>

namespace stairway::sim {
namespace {

using Eigen::Vector2d;

constexpr double kPi = std::numbers::pi;
constexpr double kRobotSpace_m = 0.9;
constexpr std::array kClutter{FurnitureKind::Box,   FurnitureKind::Column, FurnitureKind::Table,
                              FurnitureKind::Chair, FurnitureKind::Shelf,  FurnitureKind::Pallet,
                              FurnitureKind::Bench, FurnitureKind::Wall,   FurnitureKind::Radiator};

Furniture random_piece(FurnitureKind kind, const Room& room, Random& random) {
  Furniture piece;
  piece.kind = kind;
  piece.size = usual_size(kind);
  for (Eigen::Index axis = 0; axis < 3; ++axis) piece.size[axis] *= random.uniform(0.9, 1.3);
  if (kind == FurnitureKind::Column) piece.size = {piece.size.x(), piece.size.x(), room.height_m};
  piece.size.z() = std::min(piece.size.z(), room.height_m);
  piece.yaw_rad = random_yaw(random);
  piece.position = {random.uniform(room.low.x(), room.high.x()), random.uniform(room.low.y(), room.high.y())};
  return piece;
}

bool fits(const Furniture& piece, const Room& room, const std::vector<Outline>& taken) {
  const Outline footprint = piece.footprint();
  for (const auto& p : footprint) {
    if ((p.array() < room.low.array()).any() || (p.array() > room.high.array()).any()) return false;
  }
  return !overlap_any(footprint, taken);
}

// Tries some places, for a room may be full.
std::optional<Furniture> find_place(FurnitureKind kind, const Room& room, const std::vector<Outline>& taken,
                                    Random& random) {
  for (int attempt = 0; attempt < 20; ++attempt) {
    Furniture piece = random_piece(kind, room, random);
    if (fits(piece, room, taken)) return piece;
  }
  return std::nullopt;
}

// Boxes on a box. Each is higher than any step and stands back by less than a foot, so that nobody would call it
// stairs.
void stack_boxes(const Furniture& base, Random& random, std::vector<Furniture>& furniture) {
  Furniture box = base;
  for (int i = random.integer(0, 2); i > 0; --i) {
    box.level_m += box.size.z();
    box.size.head<2>() *= random.uniform(0.8, 1.0);
    box.size.z() = random.uniform(0.3, 0.5);
    furniture.push_back(box);
  }
}

}  // namespace

Outline robot_space() { return rectangle(Vector2d::Zero(), Vector2d::Constant(kRobotSpace_m), 0.0); }

std::span<const FurnitureKind> clutter() { return kClutter; }

double random_yaw(Random& random) {
  return random.chance(0.5) ? random.integer(0, 3) * kPi / 2 : random.uniform(-kPi, kPi);
}

Room room_around(const Outline& outline, Random& random) {
  Room room;
  room.low = room.high = Vector2d::Zero();
  for (const auto& p : outline) {
    room.low = room.low.cwiseMin(p);
    room.high = room.high.cwiseMax(p);
  }
  for (Eigen::Index axis = 0; axis < 2; ++axis) {
    room.low[axis] -= random.uniform(0.6, 3.0);
    room.high[axis] += random.uniform(0.6, 3.0);
  }
  room.height_m = random.uniform(2.5, 3.4);
  return room;
}

std::vector<Furniture> furnish(const Room& room, std::span<const FurnitureKind> kinds, int pieces,
                               std::vector<Outline> taken, Random& random) {
  std::vector<Furniture> furniture;
  for (int i = 0; i < pieces; ++i) {
    const FurnitureKind kind = kinds[static_cast<std::size_t>(random.integer(0, static_cast<int>(kinds.size()) - 1))];
    const auto piece = find_place(kind, room, taken, random);
    if (!piece) continue;
    furniture.push_back(*piece);
    taken.push_back(piece->footprint());
    if (kind == FurnitureKind::Box) stack_boxes(*piece, random, furniture);
  }
  return furniture;
}

std::vector<Furniture> furnish_around(const Room& room, const std::vector<Outline>& footprints, Random& random) {
  std::vector<Outline> taken;
  for (const Outline& footprint : footprints) {
    Outline view = robot_space();
    view.insert(view.end(), footprint.begin(), footprint.end());
    taken.push_back(grown(convex_hull(view), 0.05));
  }
  return furnish(room, kClutter, random.integer(3, 12), taken, random);
}

void surround(SceneSpec& spec, Random& random) {
  std::vector<Outline> footprints;
  Outline all;
  for (const StairSpec& stairs : spec.stairs) {
    footprints.push_back(build_flight(stairs).footprint);
    all.insert(all.end(), footprints.back().begin(), footprints.back().end());
  }
  spec.room = room_around(all, random);
  spec.furniture = furnish_around(spec.room, footprints, random);
}

}  // namespace stairway::sim
