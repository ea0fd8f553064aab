// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "tools/evaluation/measurement_series.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tools/sim/sweep.hpp"

namespace stairway::evaluation {
namespace {

constexpr double kFirstDistance_m = 0.5;
constexpr double kBetweenPlaces_m = 0.5;
constexpr std::size_t kPlaces = 13;
constexpr int kSweepsPerPlace = 10;
constexpr std::uint64_t kStreamsPerStairway = 1000;

}  // namespace

PaperStairway series_stairway(std::size_t index) {
  PaperStairway stairway = paper_stairways()[index == 0 ? 0 : 2];
  stairway.flight.railing_left = stairway.flight.railing_right = true;
  return stairway;
}

sim::SceneSpec robot_before(const sim::StairSpec& flight, double distance_m, sim::Random& random) {
  constexpr double kAlong_m = 0.01, kAcross_m = 0.03, kHeading_rad = 1.5 * std::numbers::pi / 180.0;
  const double ahead = distance_m + kAlong_m * random.normal();
  const double aside = kAcross_m * random.normal();
  const double heading = kHeading_rad * random.normal();
  sim::SceneSpec spec;
  spec.name = "series";
  spec.stairs = {flight};
  spec.stairs.front().position = {std::cos(heading) * ahead - std::sin(heading) * aside,
                                  std::sin(heading) * ahead + std::cos(heading) * aside};
  spec.stairs.front().heading_rad = heading;
  const double run = flight.depth_m * flight.steps + flight.landing_m;
  spec.room = {.low = {-3.0, -4.0}, .high = {distance_m + run + 2.0, 4.0}, .height_m = 4.2};
  return spec;
}

std::vector<SeriesRun> series_runs(double share, std::size_t stride) {
  const int sweeps = shared_count(kSweepsPerPlace, share);
  const std::size_t all_places = (kPlaces + stride - 1) / stride;
  const double places_share = std::min(1.0, share * kSweepsPerPlace / sweeps);
  const auto places = static_cast<std::size_t>(shared_count(static_cast<int>(all_places), places_share));
  std::vector<SeriesRun> runs;
  for (std::size_t stairway = 0; stairway < kSeriesStairways; ++stairway) {
    for (std::size_t i = 0; i < places; ++i) {
      // Spread over the distances when not all are taken, the middle one when it is only one.
      const std::size_t place = stride * ((2 * i + 1) * all_places / (2 * places));
      for (int sweep = 0; sweep < sweeps; ++sweep)
        runs.push_back({.stairway = stairway,
                        .place = place,
                        .distance_m = kFirstDistance_m + kBetweenPlaces_m * static_cast<double>(place),
                        .stream = stairway * kStreamsPerStairway + place * kSweepsPerPlace + sweep});
    }
  }
  return runs;
}

std::string SeriesRun::description() const {
  return fmt::format("stairway {} at {:.1f} m", series_stairway(stairway).name, distance_m);
}

SeriesSweep simulate_run(const SeriesRun& run, const Request& request, int threads) {
  sim::Random random{request.seed, run.stream};
  sim::Scene scene = sim::build_scene(robot_before(series_stairway(run.stairway).flight, run.distance_m, random));
  scan::PointCloud cloud = sweep_in(scene, request, run.stream, threads);
  return {std::move(cloud), std::move(scene.truths)};
}

scan::PointCloud sweep_in(const sim::Scene& scene, const Request& request, std::uint64_t stream, int threads) {
  const sim::SweepOptions options{.disk_period_s = request.settings.disk.period_s, .threads = threads};
  const std::uint64_t noise = sim::Random{~request.seed, stream}.next();
  return sim::simulate_sweep(scene, scene.mount.value_or(request.settings.mount), {}, options, noise);
}

}  // namespace stairway::evaluation
