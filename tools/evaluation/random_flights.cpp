// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "tools/evaluation/random_flights.hpp"

#include <fmt/format.h>

#include <map>

#include "tools/evaluation/error_quantity.hpp"
#include "tools/evaluation/measurement_series.hpp"
#include "tools/evaluation/parallel_runs.hpp"
#include "tools/evaluation/stairway_error.hpp"
#include "tools/sim/random_scenes.hpp"

namespace stairway::evaluation {
namespace {

/// What was found in scenes of one sort.
using Groups = std::map<std::string, std::vector<Outcome>>;

struct Sort {
  sim::SceneSpec (*make)(std::uint64_t seed);
  std::string (*group_of)(const sim::SceneSpec& spec);
  int scenes;
};

Groups measure(const Sort& sort, const Request& request) {
  const auto scenes = static_cast<std::size_t>(shared_count(sort.scenes, request.share));
  const auto results = run_with_progress(
      request, scenes,
      [&](std::size_t i) {
        const sim::SceneSpec spec = sort.make(request.seed + i);
        const sim::Scene scene = sim::build_scene(spec);
        const scan::PointCloud cloud = sweep_in(scene, request, i, 1);
        const detect::Detection detection = detect::detect_stairways(cloud, request.settings.detector);
        return std::pair{sort.group_of(spec), outcome_of(detection, scene.truths)};
      },
      [&](std::size_t i) { return fmt::format("scene {}", request.seed + i); });
  Groups groups;
  for (const auto& [group, outcome] : results) {
    groups[group].push_back(outcome);
    groups["together"].push_back(outcome);
  }
  return groups;
}

Table make_table(const std::string& name, const std::string& title, const Groups& groups, const Column& right,
                 bool StairwayError::*is_right, const std::vector<ErrorQuantity>& quantities) {
  Table table{
      .name = name,
      .title = title,
      .columns =
          {{"stairways", ""}, {"runs", "", 0}, {"found", "", 0}, right, {"right_steps", "", 0}, {"false", "", 0}},
      .rows = {}};
  append_error_columns(table.columns, quantities);
  for (const auto& [group, outcomes] : groups) {
    std::vector<Cell> row{group,
                          static_cast<double>(outcomes.size()),
                          static_cast<double>(found_count(outcomes)),
                          static_cast<double>(found_count(outcomes, is_right)),
                          static_cast<double>(right_step_count(outcomes)),
                          static_cast<double>(false_count(outcomes))};
    append_errors(row, outcomes, quantities);
    table.rows.push_back(std::move(row));
  }
  return table;
}

Chart make_chart(const std::string& name, const std::string& title, const Groups& groups) {
  Chart chart{.name = name, .title = title, .y_label = "mean absolute error [mm]"};
  for (const ErrorQuantity& quantity : {kHeightError, kDepthError}) {
    Curve curve{.name = quantity.name};
    for (const auto& [group, outcomes] : groups) {
      const Spread s = absolute_error(outcomes, quantity);
      curve.add(static_cast<double>(curve.x.size()), s.mean, s.deviation);
    }
    chart.curves.push_back(std::move(curve));
  }
  for (const auto& [group, outcomes] : groups) chart.categories.push_back(group);
  return chart;
}

std::string spiral_group(const sim::SceneSpec& spec) {
  const sim::StairSpec& flight = spec.stairs.front();
  return fmt::format("{}, turns {}", flight.open_risers ? "open" : "closed",
                     flight.turn_per_step_rad > 0.0 ? "left" : "right");
}

std::string mount_group(const sim::SceneSpec& spec) {
  return spec.mount && spec.mount->scan_plane_pitch_rad < 0.0 ? "inverted mount" : "upright mount";
}

const char* const kErrors =
    "Errors are means of absolute values over the stairways found, with the standard deviation beside them; anchor is "
    "the horizontal distance of the anchor from its true place.";

}  // namespace

Result run_spiral(const Request& request) {
  const Groups groups = measure({sim::random_spiral_scene, spiral_group, 60}, request);
  const Column kind{"found_as_spiral", "", 0};
  return {.tables = {make_table("spiral", "Spirals in furnished rooms (Fig 17 d)", groups, kind,
                                &StairwayError::is_right_kind,
                                {kHeightError, kDepthError, kTurnError, kWidthError, kAnchorError})},
          .charts = {make_chart("spiral-errors", "Spirals: errors of height and depth", groups)},
          .notes = {fmt::format("The scenes are sim:random-spiral:{} and the following.", request.seed), kErrors,
                    "Depth is the chord at the middle of the width, and turn the angle from step to step. The paper "
                    "shows one spiral that was found and states no figures."}};
}

Result run_descending(const Request& request) {
  const Groups groups = measure({sim::random_descending_scene, mount_group, 40}, request);
  const Column direction{"found_as_descending", "", 0};
  return {.tables = {make_table("descending", "Descending flights seen from their upper edge (Fig 17 c)", groups,
                                direction, &StairwayError::is_right_direction,
                                {kHeightError, kDepthError, kWidthError, kHeadingError, kAnchorError})},
          .charts = {make_chart("descending-errors", "Descending flights: errors of height and depth", groups)},
          .notes = {fmt::format("The scenes are sim:random-descending:{} and the following. Flights for the upright "
                                "mount are shallow and long, or it could not see their treads; the inverted mount has "
                                "usual ones.",
                                request.seed),
                    kErrors,
                    "The paper shows one flight that was found from its upper edge and states no figures; from further "
                    "away its scanner saw no tread."}};
}

}  // namespace stairway::evaluation
