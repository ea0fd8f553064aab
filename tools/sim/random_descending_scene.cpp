// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <string>
#include <utility>

#include "tools/sim/angles.hpp"
#include "tools/sim/random_flight.hpp"
#include "tools/sim/random_layout.hpp"
#include "tools/sim/random_scenes.hpp"

namespace stairway::sim {
namespace {

using Eigen::Vector2d;

constexpr double kPi = std::numbers::pi;
constexpr std::uint64_t kDescendingStream = 4;
constexpr std::uint64_t kMidLandingStream = 5;
constexpr std::uint64_t kInvertedDescendingStream = 8;
constexpr double kMaxSkew_rad = 25 * kDegree;

scan::MountOptions inverted_mount() {
  scan::MountOptions mount;
  mount.scan_plane_pitch_rad = -60 * kDegree;
  return mount;
}

void draw_look(StairSpec& spec, Random& random) {
  spec.width_m = random.uniform(0.9, 1.8);
  spec.open_risers = random.chance(0.2);
  draw_fittings(spec, random);
}

StairSpec usual_flight(Random& random) {
  StairSpec spec;
  spec.steps = random.integer(5, 10);
  draw_usual_steps(spec, random);
  draw_look(spec, random);
  return spec;
}

StairSpec shallow_flight(Random& random) {
  StairSpec spec;
  spec.steps = random.integer(9, 14);
  spec.depth_m = random.uniform(0.36, 0.40);
  spec.height_m = spec.depth_m * std::tan(random.uniform(20.5 * kDegree, 23 * kDegree));
  draw_look(spec, random);
  return spec;
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

namespace {

SceneSpec descending_scene(std::string name, bool is_inverted, Random& random) {
  constexpr double kNearest_m = 0.27;
  SceneSpec spec;
  spec.name = std::move(name);
  StairSpec flight = is_inverted ? usual_flight(random) : shallow_flight(random);
  do {
    place_edge(flight, random_yaw(random), kNearest_m, random);
  } while (overlap(build_flight(flight).footprint, robot_outline()));
  spec.stairs = {flight};
  surround(spec, random);
  spec.mount = is_inverted ? inverted_mount() : scan::MountOptions{};
  return spec;
}

}  // namespace

SceneSpec random_descending_scene(std::uint64_t seed) {
  Random random{seed, kDescendingStream};
  const bool is_inverted = random.chance(0.5);
  return descending_scene(fmt::format("random-descending:{}", seed), is_inverted, random);
}

SceneSpec random_inverted_descending_scene(std::uint64_t seed) {
  Random random{seed, kInvertedDescendingStream};
  return descending_scene(fmt::format("random-inverted-descending:{}", seed), true, random);
}

SceneSpec random_mid_landing_scene(std::uint64_t seed) {
  constexpr double kNearest_m = 0.30;
  Random random{seed, kMidLandingStream};
  SceneSpec spec;
  spec.name = fmt::format("random-mid-landing:{}", seed);
  StairSpec down = usual_flight(random);
  place_edge(down, random_yaw(random), kNearest_m, random);
  const Outline hole = build_flight(down).footprint;
  StairSpec up = usual_flight(random);
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
  surround(spec, random);
  spec.mount = inverted_mount();
  return spec;
}

}  // namespace stairway::sim
