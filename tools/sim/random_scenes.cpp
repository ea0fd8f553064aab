// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "tools/sim/random_scenes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>

#include "tools/sim/random.hpp"

namespace stairway::sim {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kPi = std::numbers::pi;
constexpr double kDegree = kPi / 180.0;
constexpr std::uint64_t kStairStream = 1;
constexpr std::uint64_t kRoomStream = 2;
constexpr double kRobotSpace_m = 0.9;  // side of the square that clutter leaves to the robot

Outline robot_space() { return rectangle(Vector2d::Zero(), Vector2d::Constant(kRobotSpace_m), 0.0); }

// A turn that is a multiple of a right angle half of the time, as most things in rooms are.
double random_yaw(Random& random) {
  return random.chance(0.5) ? random.integer(0, 3) * kPi / 2 : random.uniform(-kPi, kPi);
}

StairSpec random_flight(Random& random) {
  StairSpec spec;
  spec.steps = random.integer(4, 12);
  do {
    spec.height_m = random.uniform(0.14, 0.20);
    spec.depth_m = random.uniform(0.24, 0.34);
  } while (std::abs(2 * spec.height_m + spec.depth_m - 0.64) > 0.06);
  spec.width_m = random.uniform(0.8, 1.6);
  spec.open_risers = random.chance(0.3);
  spec.tread_thickness_m = random.uniform(0.03, 0.06);
  spec.overhang_m = random.chance(0.5) ? random.uniform(0.0, 0.03) : 0.0;
  spec.railing_left = random.chance(0.35);
  spec.railing_right = random.chance(0.35);
  spec.landing_m = random.uniform(0.8, 1.6);
  do {
    const double distance = random.uniform(0.6, 4.0);
    const double skew = random.uniform(-40 * kDegree, 40 * kDegree);
    spec.heading_rad = random_yaw(random);
    const double bearing = spec.heading_rad - skew;
    spec.position = distance * Vector2d{std::cos(bearing), std::sin(bearing)};
  } while (overlap(build_flight(spec).footprint, robot_space()));
  return spec;
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
  return std::none_of(taken.begin(), taken.end(), [&](const Outline& other) { return overlap(footprint, other); });
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

void furnish(SceneSpec& spec, std::span<const FurnitureKind> kinds, int pieces, std::vector<Outline> taken,
             Random& random) {
  for (int i = 0; i < pieces; ++i) {
    const FurnitureKind kind = kinds[static_cast<std::size_t>(random.integer(0, static_cast<int>(kinds.size()) - 1))];
    const auto piece = find_place(kind, spec.room, taken, random);
    if (!piece) continue;
    spec.furniture.push_back(*piece);
    taken.push_back(piece->footprint());
    if (kind == FurnitureKind::Box) stack_boxes(*piece, random, spec.furniture);
  }
}

}  // namespace

SceneSpec random_stair_scene(std::uint64_t seed) {
  static constexpr std::array kClutter{FurnitureKind::Box,   FurnitureKind::Column, FurnitureKind::Table,
                                       FurnitureKind::Chair, FurnitureKind::Shelf,  FurnitureKind::Pallet,
                                       FurnitureKind::Bench, FurnitureKind::Wall,   FurnitureKind::Radiator};
  Random random{seed, kStairStream};
  SceneSpec spec;
  spec.name = fmt::format("random-stairs:{}", seed);
  spec.stairs = {random_flight(random)};
  const Outline footprint = build_flight(spec.stairs.front()).footprint;
  spec.room = room_around(footprint, random);
  std::vector<Vector2d> view = robot_space();
  view.insert(view.end(), footprint.begin(), footprint.end());
  furnish(spec, kClutter, random.integer(3, 12), {grown(convex_hull(view), 0.05)}, random);
  return spec;
}

SceneSpec random_room(std::uint64_t seed) {
  static constexpr std::array kThings{
      FurnitureKind::Box,      FurnitureKind::Box,       FurnitureKind::Column,    FurnitureKind::Table,
      FurnitureKind::Chair,    FurnitureKind::Shelf,     FurnitureKind::Shelf,     FurnitureKind::Pallet,
      FurnitureKind::Bench,    FurnitureKind::Wall,      FurnitureKind::Radiator,  FurnitureKind::Ramp,
      FurnitureKind::DoorStep, FurnitureKind::DoorFrame, FurnitureKind::Bleachers, FurnitureKind::Platform};
  Random random{seed, kRoomStream};
  SceneSpec spec;
  spec.name = fmt::format("random-room:{}", seed);
  spec.room = room_around({Vector2d{-1.5, -1.5}, Vector2d{1.5, 1.5}}, random);
  furnish(spec, kThings, random.integer(8, 24), {robot_space()}, random);
  return spec;
}

}  // namespace stairway::sim
