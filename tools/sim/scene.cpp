// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "tools/sim/scene.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>

namespace stairway::sim {
namespace {

constexpr double kHeadroom_m = 2.1;
constexpr double kRobotRadius_m = 0.2;

Outline outline_of(const Room& room) { return rectangle_between(room.low, room.high); }

bool is_inside(const Room& room, const Outline& outline) {
  for (const auto& p : outline) {
    if ((p.array() < room.low.array() - 1e-9).any() || (p.array() > room.high.array() + 1e-9).any()) return false;
  }
  return true;
}

std::string problem_of(const Room& room) {
  for (const double number : {room.low.x(), room.low.y(), room.high.x(), room.high.y(), room.height_m}) {
    if (!(std::abs(number) <= 50)) return "room: numbers must lie within 50 m";
  }
  if (!((room.low.array() < -kRobotRadius_m).all() && (room.high.array() > kRobotRadius_m).all())) {
    return fmt::format("room: must hold the robot, which fills {} m around x = y = 0", kRobotRadius_m);
  }
  if (!(room.height_m >= 1.0)) return fmt::format("room: height {} m is below 1 m", room.height_m);
  return {};
}

void add_shaft(Mesh& mesh, const Outline& outline, double z_low_m, double z_high_m, double z_end_m) {
  mesh.add_walls(outline, z_low_m, z_high_m);
  mesh.add_horizontal(outline, z_end_m);
}

}  // namespace

Outline robot_outline() {
  constexpr int kCorners = 24;
  Outline outline;
  for (int i = 0; i < kCorners; ++i) {
    const double angle = 2 * std::numbers::pi * i / kCorners;
    outline.emplace_back(kRobotRadius_m * std::cos(angle), kRobotRadius_m * std::sin(angle));
  }
  return outline;
}

std::string SceneSpec::problem() const {
  if (auto text = problem_of(room); !text.empty()) return text;
  for (std::size_t i = 0; i < stairs.size(); ++i) {
    const std::string where = fmt::format("stairs[{}]: ", i);
    if (auto text = stairs[i].problem(); !text.empty()) return where + text;
    const Outline footprint = build_flight(stairs[i]).footprint;
    if (!is_inside(room, footprint)) return where + "the flight with its landing does not fit into the room";
    if (overlap(footprint, robot_outline())) return where + "the flight covers the place of the robot";
  }
  for (std::size_t i = 0; i < furniture.size(); ++i) {
    const std::string where = fmt::format("furniture[{}]: ", i);
    if (!((furniture[i].size.array() > 0.005).all() && (furniture[i].size.array() < 50).all())) {
      return where + "each size must lie between 0.005 and 50 m";
    }
    if (!(furniture[i].position.norm() < 50) || !(std::abs(furniture[i].yaw_rad) < 10) ||
        !(std::abs(furniture[i].level_m) < 50)) {
      return where + "position, yaw or level is out of bounds";
    }
    if (overlap(furniture[i].footprint(), robot_outline())) return where + "stands on the place of the robot";
  }
  return {};
}

Scene build_scene(const SceneSpec& spec) {
  if (const std::string problem = spec.problem(); !problem.empty()) throw std::invalid_argument{problem};
  Scene scene{.name = spec.name, .mesh = {}, .truths = {}, .mount = spec.mount, .stairs = spec.stairs};
  std::vector<Outline> floor{outline_of(spec.room)};
  std::vector<Outline> ceiling = floor;
  for (const auto& stairs : spec.stairs) {
    const Flight flight = build_flight(stairs);
    scene.mesh.append(flight.mesh);
    scene.truths.push_back(flight.truth);
    if (flight.low_m < 0) {
      cut(floor, flight.footprint);
      add_shaft(scene.mesh, flight.footprint, flight.low_m, 0.0, flight.low_m);
    }
    if (flight.high_m + kHeadroom_m > spec.room.height_m) {
      cut(ceiling, flight.footprint);
      const double end = flight.high_m + kHeadroom_m;
      add_shaft(scene.mesh, flight.footprint, spec.room.height_m, end, end);
    }
  }
  scene.mesh.add_horizontal(floor, 0.0);
  scene.mesh.add_horizontal(ceiling, spec.room.height_m);
  scene.mesh.add_walls(outline_of(spec.room), 0.0, spec.room.height_m);
  for (const auto& piece : spec.furniture) scene.mesh.append(build_furniture(piece));
  return scene;
}

}  // namespace stairway::sim
