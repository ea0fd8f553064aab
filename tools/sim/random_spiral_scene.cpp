// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "tools/sim/angles.hpp"
#include "tools/sim/random_flight.hpp"
#include "tools/sim/random_layout.hpp"
#include "tools/sim/random_scenes.hpp"

namespace stairway::sim {
namespace {

constexpr std::uint64_t kSpiralStream = 3;
constexpr double kHeadroom_m = 2.0;
constexpr double kLandingThickness_m = 0.16;

// The landing and the last treads lie over the first ones from about three quarters of a turn on.
bool leaves_headroom(const StairSpec& spec) {
  const double turn = spec.steps * std::abs(spec.turn_per_step_rad);
  if (turn > 2 * std::numbers::pi) return false;
  return turn < 1.4 * std::numbers::pi || (spec.steps - 1) * spec.height_m - kLandingThickness_m >= kHeadroom_m;
}

bool can_be_walked(const StairSpec& spec) { return std::abs(2 * spec.height_m + spec.depth_m - 0.62) < 0.06; }

StairSpec random_spiral(Random& random) {
  StairSpec spec;
  const double side = random.chance(0.5) ? 1.0 : -1.0;
  do {
    spec.steps = random.integer(8, 14);
    spec.height_m = random.uniform(0.15, 0.21);
    spec.depth_m = random.uniform(0.20, 0.30);
    spec.width_m = random.uniform(0.7, 1.2);
    spec.turn_per_step_rad = side * random.uniform(12 * kDegree, 36 * kDegree);
  } while (!can_be_walked(spec) || !leaves_headroom(spec) || !spec.problem().empty());
  spec.open_risers = random.chance(0.4);
  spec.tread_thickness_m = random.uniform(0.03, 0.06);
  spec.overhang_m = random.chance(0.5) ? random.uniform(0.0, 0.03) : 0.0;
  const bool has_railing = random.chance(0.4);  // on the outer side, away from the column
  spec.railing_left = has_railing && side < 0;
  spec.railing_right = has_railing && side > 0;
  spec.landing_m = random.uniform(0.6, 1.0);
  place_before_robot(spec, 0.8, 3.0, random);
  return spec;
}

}  // namespace

SceneSpec random_spiral_scene(std::uint64_t seed) {
  Random random{seed, kSpiralStream};
  SceneSpec spec;
  spec.name = fmt::format("random-spiral:{}", seed);
  spec.stairs = {random_spiral(random)};
  surround(spec, random);
  return spec;
}

}  // namespace stairway::sim
