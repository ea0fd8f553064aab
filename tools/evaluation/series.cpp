// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "tools/evaluation/series.hpp"

#include <fmt/format.h>

#include <array>
#include <map>

#include "tools/evaluation/measurement_series.hpp"
#include "tools/evaluation/parallel_runs.hpp"
#include "tools/evaluation/series_charts.hpp"
#include "tools/evaluation/stairway_error.hpp"

namespace stairway::evaluation {
namespace {

using Outcomes = std::array<Outcome, kSeriesStrategies.size()>;

Outcomes detect_with_every_strategy(const SeriesRun& run, const Request& request) {
  const SeriesSweep sweep = simulate_run(run, request, 1);
  Outcomes outcomes;
  for (std::size_t i = 0; i < kSeriesStrategies.size(); ++i) {
    detect::DetectorOptions options = request.settings.detector;
    options.competition.strategy = kSeriesStrategies[i].strategy;
    outcomes[i] = outcome_of(detect::detect_stairways(sweep.cloud, options), sweep.truths);
  }
  return outcomes;
}

std::vector<SeriesPlace> measure(const Request& request) {
  const std::vector<SeriesRun> runs = series_runs(request.share);
  const auto results = run_with_progress(
      request, runs.size(), [&](std::size_t i) { return detect_with_every_strategy(runs[i], request); },
      [&](std::size_t i) { return runs[i].description(); });
  std::map<std::tuple<std::size_t, std::size_t, std::size_t>, SeriesPlace> places;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    for (std::size_t s = 0; s < kSeriesStrategies.size(); ++s) {
      SeriesPlace& place = places[{runs[i].stairway, s, runs[i].place}];
      place.stairway = runs[i].stairway;
      place.strategy = s;
      place.distance_m = runs[i].distance_m;
      place.outcomes.push_back(results[i][s]);
    }
  }
  std::vector<SeriesPlace> ordered;
  for (auto& [key, place] : places) ordered.push_back(std::move(place));
  return ordered;
}

}  // namespace

Result run_series(const Request& request) {
  const std::vector<SeriesPlace> places = measure(request);
  Result result;
  for (const std::size_t stairway : {0U, 1U}) {
    result.tables.push_back(coefficient_table(stairway, places));
    result.tables.push_back(localisation_table(stairway, places));
    for (Chart& chart : series_charts(stairway, places)) result.charts.push_back(std::move(chart));
  }
  result.charts.push_back(detection_chart(places));
  result.tables.push_back(comparison_table(places));
  const auto describe = [](const PaperStairway& stairway) {
    const sim::StairSpec& f = stairway.flight;
    return fmt::format("Stairway {}: {} steps of {:.0f} by {:.0f} mm, {:.1f} m wide, {}, railings on both sides.",
                       stairway.name, f.steps, 1e3 * f.height_m, 1e3 * f.depth_m, f.width_m,
                       f.open_risers ? "boards of 40 mm on stringers" : "closed risers");
  };
  result.notes = {
      describe(series_stairway(0)) + " " + describe(series_stairway(1)) +
          " The paper states no dimensions; these are typical.",
      "Distances are from the disk axis to the first nosing. The paper counts from a robot that stands right in front "
      "of the stairway (0 m) and states 4 of 10 found at 4.5 m for I, all up to 6.5 m for III, where a wall ended its "
      "series.",
      "Every sweep has its own noise, and its robot stands 1 cm along, 3 cm across and 1.5 degrees off its place (one "
      "standard deviation each), as one put down by hand.",
      "Errors are means of absolute values over the stairways found, with the standard deviation beside them; along is "
      "the paper's delta x, in the direction of the stairway, across its delta y, both of the anchor.",
      "A simulated scanner is calibrated exactly and stands level; the paper's figures were measured on real stairs."};
  return result;
}

}  // namespace stairway::evaluation
