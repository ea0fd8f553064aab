// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/bench/speed/clouds.hpp"

#include <algorithm>
#include <span>
#include <stdexcept>

#include "tools/sim/building.hpp"
#include "tools/sim/merged_sweeps.hpp"
#include "tools/sim/scene_file.hpp"
#include "tools/sim/sweep.hpp"

namespace stairway::bench {
namespace {

constexpr std::uint64_t kSeed = 1;
constexpr double kStopPeriod_s = 7.0;
constexpr std::size_t kPointsOfStop = 250'000;  // at the least

sim::Scene sweep_scene() { return sim::build_scene(sim::load_scene("straight-flight")); }

// Two rooms to a side keep a storey small: PCL numbers the cells of its grid with 32 bits, which end where the box
// around a cloud holds 2147 cubic metres.
sim::Building tower() { return sim::build_building({.storeys = 14, .rooms = 2, .stairwells = 1, .seed = kSeed}); }

}  // namespace

scan::PointCloud take_sweep() { return sim::simulate_sweep(sweep_scene(), {}, {}, {}, kSeed); }

std::vector<detect::Stairway> sweep_truths() { return sweep_scene().truths; }

scan::PointCloud walk_through_tower(std::size_t points) {
  const sim::Building building = tower();
  const std::size_t stops = std::min(points / kPointsOfStop + 1, building.stands.size());
  scan::PointCloud cloud = sim::simulate_merged(building.scene, std::span(building.stands).first(stops), {}, {},
                                                {.disk_period_s = kStopPeriod_s}, kSeed);
  if (cloud.points.size() < points) throw std::length_error("the tower has no more points to see");
  cloud.points.resize(points);
  return cloud;
}

std::vector<detect::Stairway> tower_truths() { return tower().scene.truths; }

std::vector<detect::Stairway> truths_of(const std::string& cloud) {
  if (cloud == "sweep") return sweep_truths();
  if (cloud == "tower") return tower_truths();
  throw std::invalid_argument("there is no cloud '" + cloud + "'");
}

}  // namespace stairway::bench
