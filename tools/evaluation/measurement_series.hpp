// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "scan_assembly/point_cloud.hpp"
#include "tools/evaluation/experiment.hpp"
#include "tools/evaluation/paper_stairways.hpp"
#include "tools/sim/random.hpp"
#include "tools/sim/scene.hpp"

namespace stairway::evaluation {

/// Stairway I (0) or III (1) of paper_stairways(), with railings on both sides.
PaperStairway series_stairway(std::size_t index);
inline constexpr std::size_t kSeriesStairways = 2;

/// A robot put down in front of `flight` by a person: its first nosing `distance_m` ahead of the disk axis, give or
/// take 1 cm along, 3 cm across and 1.5 degrees in heading (one standard deviation each), in an empty hall.
sim::SceneSpec robot_before(const sim::StairSpec& flight, double distance_m, sim::Random& random);

/// One sweep of a series.
struct SeriesRun {
  std::size_t stairway = 0;  ///< of series_stairway()
  std::size_t place = 0;     ///< index of the distance
  double distance_m = 0.0;
  std::uint64_t stream = 0;  ///< of random numbers; the same sweep has the same one in every experiment

  std::string description() const;  ///< for a person, e.g. "stairway III at 2.5 m"
};

/// The sweeps of the paper's Fig 18: 0.5 to 6.5 m before stairways I and III, ten at each place.
/// @param share   of them in (0, 1]: first fewer sweeps per place, then fewer places; at least one per stairway.
/// @param stride  takes every stride-th place only.
std::vector<SeriesRun> series_runs(double share, std::size_t stride = 1);

/// A sweep and what there is to find in it.
struct SeriesSweep {
  scan::PointCloud cloud;
  std::vector<detect::Stairway> truths;
};

/// @param threads  as in sim::SweepOptions.
SeriesSweep simulate_run(const SeriesRun& run, const Request& request, int threads);

/// Takes a sweep in any scene with the mount that suits it, else that of the settings.
/// @param stream  together with the request's seed, decides the noise.
scan::PointCloud sweep_in(const sim::Scene& scene, const Request& request, std::uint64_t stream, int threads);

}  // namespace stairway::evaluation
