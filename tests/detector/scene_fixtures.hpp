// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <cmath>

#include "detector/stairway.hpp"
#include "tools/sim/random_scenes.hpp"
#include "tools/sim/scene.hpp"
#include "tools/sim/sweep.hpp"

namespace stairway::detect::test {

struct SimulatedRoom {
  scan::PointCloud cloud;
  Stairway truth;
};

/// One flight in an empty hall, its first nosing `distance_m` ahead, seen in a turn of `disk_period_s`.
inline SimulatedRoom simulate(sim::StairSpec flight, double distance_m, double heading_rad, double disk_period_s,
                              std::uint64_t seed = 1) {
  flight.position = Eigen::Vector2d(distance_m, 0.0);
  flight.heading_rad = heading_rad;
  sim::SceneSpec spec;
  spec.room = {.low = {-4.0, -6.0}, .high = {11.0, 6.0}};
  spec.stairs = {flight};
  const sim::Scene scene = sim::build_scene(spec);
  sim::SweepOptions sweep;
  sweep.disk_period_s = disk_period_s;
  return {sim::simulate_sweep(scene, {}, {}, sweep, seed), scene.truths.front()};
}

/// A furnished room without stairs.
inline scan::PointCloud simulate_room(std::uint64_t seed, double disk_period_s) {
  sim::SweepOptions sweep;
  sweep.disk_period_s = disk_period_s;
  return sim::simulate_sweep(sim::build_scene(sim::random_room(seed)), {}, {}, sweep, seed);
}

/// How far two headings differ [rad].
inline double turn_between(double a, double b) { return std::abs(std::remainder(a - b, 2.0 * M_PI)); }

}  // namespace stairway::detect::test
