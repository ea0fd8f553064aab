// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "tools/sim/random_layout.hpp"
#include "tools/sim/random_scenes.hpp"

namespace stairway::sim {
namespace {

using Eigen::Vector2d;

constexpr double kPi = std::numbers::pi;
constexpr double kDegree = kPi / 180.0;
constexpr std::uint64_t kDescendingStream = 4;
constexpr std::uint64_t kMidLandingStream = 5;
constexpr double kMaxSkew_rad = 25 * kDegree;

Vector2d unit(double angle_rad) { return {std::cos(angle_rad), std::sin(angle_rad)}; }

scan::MountOptions inverted_mount() {
  scan::MountOptions mount;
  mount.scan_plane_pitch_rad = -60 * kDegree;
  return mount;
}

void draw_usual_steps(StairSpec& spec, Random& random) {
  spec.steps = random.integer(5, 10);
  do {
    spec.height_m = random.uniform(0.14, 0.20);
    spec.depth_m = random.uniform(0.24, 0.34);
  } while (std::abs(2 * spec.height_m + spec.depth_m - 0.64) > 0.06);
}

void draw_shallow_steps(StairSpec& spec, Random& random) {
  spec.steps = random.integer(9, 14);
  spec.depth_m = random.uniform(0.36, 0.40);
  spec.height_m = spec.depth_m * std::tan(random.uniform(20.5 * kDegree, 23 * kDegree));
}

// How the flight looks apart from its steps.
void draw_fittings(StairSpec& spec, Random& random) {
  spec.width_m = random.uniform(0.9, 1.8);
  spec.open_risers = random.chance(0.2);
  spec.tread_thickness_m = random.uniform(0.03, 0.06);
  spec.overhang_m = random.chance(0.5) ? random.uniform(0.0, 0.03) : 0.0;
  spec.railing_left = random.chance(0.35);
  spec.railing_right = random.chance(0.35);
  spec.landing_m = random.uniform(0.8, 1.6);
}

// Puts the upper edge across `direction`, the way down.
void place_edge(StairSpec& spec, double direction_rad, double nearest_m, Random& random) {
  spec.descending = true;
  spec.heading_rad = std::remainder(direction_rad + kPi, 2 * kPi);
  const double skew = random.uniform(-kMaxSkew_rad, kMaxSkew_rad);
  // Both the way to the middle of the edge and, down the slope, to the edge itself keep within the bounds.
  const double distance = random.uniform(nearest_m / std::cos(skew), 0.70);
  spec.position = distance * unit(direction_rad + skew);
}

StairSpec flight_up(Random& random) {
  StairSpec spec;
  draw_usual_steps(spec, random);
  draw_fittings(spec, random);
  return spec;
}

// Beside the flight that goes down, its first step near the edge: the usual stairwell.
void place_beside(StairSpec& up, const StairSpec& down, Random& random) {
  up.heading_rad = std::remainder(down.heading_rad + kPi, 2 * kPi);
  const Vector2d across = (random.chance(0.5) ? 1.0 : -1.0) * unit(up.heading_rad + kPi / 2);
  const double apart = (up.width_m + down.width_m) / 2 + random.uniform(0.05, 0.4);
  up.position = down.position + apart * across + random.uniform(0.1, 0.8) * unit(up.heading_rad);
}

void place_elsewhere(StairSpec& up, Random& random) {
  up.heading_rad = random_yaw(random);
  up.position = random.uniform(0.7, 2.5) * unit(up.heading_rad + random.uniform(-30 * kDegree, 30 * kDegree));
}

}  // namespace

SceneSpec random_descending_scene(std::uint64_t seed) {
  constexpr double kNearest_m = 0.27;
  Random random{seed, kDescendingStream};
  SceneSpec spec;
  spec.name = fmt::format("random-descending:{}", seed);
  StairSpec flight;
  const bool is_inverted = random.chance(0.5);
  if (is_inverted) {
    draw_usual_steps(flight, random);
  } else {
    draw_shallow_steps(flight, random);
  }
  draw_fittings(flight, random);
  place_edge(flight, random_yaw(random), kNearest_m, random);
  const Outline footprint = build_flight(flight).footprint;
  spec.stairs = {flight};
  spec.room = room_around(footprint, random);
  spec.furniture = furnish_around(spec.room, {footprint}, random);
  spec.mount = is_inverted ? inverted_mount() : scan::MountOptions{};
  return spec;
}

SceneSpec random_mid_landing_scene(std::uint64_t seed) {
  constexpr double kNearest_m = 0.30;
  Random random{seed, kMidLandingStream};
  SceneSpec spec;
  spec.name = fmt::format("random-mid-landing:{}", seed);
  StairSpec down;
  draw_usual_steps(down, random);
  draw_fittings(down, random);
  place_edge(down, random_yaw(random), kNearest_m, random);
  const Outline hole = build_flight(down).footprint;
  StairSpec up = flight_up(random);
  const bool is_beside = random.chance(0.5);
  Outline footprint;
  do {
    if (is_beside) {
      place_beside(up, down, random);
    } else {
      place_elsewhere(up, random);
    }
    footprint = build_flight(up).footprint;
  } while (overlap(footprint, grown(hole, 0.02)) || overlap(footprint, robot_space()));
  spec.stairs = {up, down};
  Outline both = hole;
  both.insert(both.end(), footprint.begin(), footprint.end());
  spec.room = room_around(both, random);
  spec.furniture = furnish_around(spec.room, {hole, footprint}, random);
  spec.mount = inverted_mount();
  return spec;
}

}  // namespace stairway::sim
