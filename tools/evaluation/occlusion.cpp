// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "tools/evaluation/occlusion.hpp"

#include <fmt/format.h>

#include <numbers>

#include "tools/evaluation/error_quantity.hpp"
#include "tools/evaluation/measurement_series.hpp"
#include "tools/evaluation/parallel_runs.hpp"
#include "tools/evaluation/stairway_error.hpp"

namespace stairway::evaluation {
namespace {

constexpr double kDistances_m[] = {2.0, 3.0};
constexpr double kHiddenShares[] = {0.15, 0.3, 0.45, 0.6};
constexpr int kSweeps = 10;
constexpr std::uint64_t kFirstStream = 10'000;
constexpr double kPaperError_mm = 28.0;

/// One place of the wall.
struct Place {
  double distance_m = 0.0;    ///< of the first nosing
  double hidden_share = 0.0;  ///< of the width of the first nosing
};

std::vector<Place> all_places() {
  std::vector<Place> places;
  for (const double distance : kDistances_m)
    for (const double share : kHiddenShares) places.push_back({distance, share});
  return places;
}

/// A wall across the hall half way to the stairway. It ends where the line of sight to the nosing's hidden part begins.
sim::Furniture wall_before(const sim::StairSpec& flight, double hidden_share) {
  constexpr double kHalfWay = 0.5, kThickness_m = 0.12, kHeight_m = 4.0;
  const Eigen::Vector2d ascent(std::cos(flight.heading_rad), std::sin(flight.heading_rad));
  const Eigen::Vector2d left(-ascent.y(), ascent.x());
  const Eigen::Vector2d last_hidden = flight.position + (hidden_share - 0.5) * flight.width_m * left;
  const double length = 0.5 * flight.width_m + 1.5;
  sim::Furniture wall;
  wall.kind = sim::FurnitureKind::Wall;
  wall.size = {length, kThickness_m, kHeight_m};
  wall.position = kHalfWay * last_hidden - 0.5 * length * left;
  wall.yaw_rad = flight.heading_rad + 0.5 * std::numbers::pi;
  return wall;
}

Outcome look_past_wall(const Place& place, std::uint64_t stream, const Request& request) {
  sim::Random random{request.seed, stream};
  sim::SceneSpec spec = robot_before(series_stairway(1).flight, place.distance_m, random);
  spec.furniture.push_back(wall_before(spec.stairs.front(), place.hidden_share));
  const sim::Scene scene = sim::build_scene(spec);
  const scan::PointCloud cloud = sweep_in(scene, request, stream, 1);
  return outcome_of(detect::detect_stairways(cloud, request.settings.detector), scene.truths);
}

std::vector<std::vector<Outcome>> measure(const std::vector<Place>& places, std::size_t sweeps,
                                          const Request& request) {
  const std::size_t count = places.size() * sweeps;
  const auto outcomes = run_with_progress(
      request, count,
      [&](std::size_t i) {
        const std::size_t place = i / sweeps;
        return look_past_wall(places[place], kFirstStream + place * kSweeps + i % sweeps, request);
      },
      [&](std::size_t i) {
        const Place& place = places[i / sweeps];
        return fmt::format("{:.0f} % hidden at {:.1f} m", 100.0 * place.hidden_share, place.distance_m);
      });
  std::vector<std::vector<Outcome>> by_place(places.size());
  for (std::size_t i = 0; i < count; ++i) by_place[i / sweeps].push_back(outcomes[i]);
  return by_place;
}

int anchored_left(const std::vector<Outcome>& outcomes) {
  return found_count(outcomes, [](const StairwayError& e) { return e.anchor_side == detect::AnchorSide::Left; });
}

Table make_table(const std::vector<Place>& places, const std::vector<std::vector<Outcome>>& outcomes) {
  Table table{.name = "occlusion",
              .title = "Stairway III, its right side hidden by a wall: error of the anchor (Fig 11)",
              .columns = {{"distance", "m", 1},
                          {"hidden", "%", 0},
                          {"runs", "", 0},
                          {"found", "", 0},
                          {"anchored_left", "", 0},
                          {"anchor_error", "mm", 1},
                          {"anchor_sd", "mm", 1},
                          {"anchor_largest", "mm", 1},
                          {"middle_error", "mm", 1},
                          {"middle_sd", "mm", 1},
                          {"paper_anchor_error", "mm", 0}},
              .rows = {}};
  for (std::size_t i = 0; i < places.size(); ++i) {
    const Spread anchor = absolute_error(outcomes[i], kAnchorError);
    const Spread middle = absolute_error(outcomes[i], kMiddleError);
    table.rows.push_back({places[i].distance_m, 100.0 * places[i].hidden_share, static_cast<double>(outcomes[i].size()),
                          static_cast<double>(found_count(outcomes[i])),
                          static_cast<double>(anchored_left(outcomes[i])), anchor.mean, anchor.deviation,
                          anchor.largest, middle.mean, middle.deviation, kPaperError_mm});
  }
  return table;
}

Chart make_chart(const std::vector<Place>& places, const std::vector<std::vector<Outcome>>& outcomes) {
  Chart chart{.name = "occlusion",
              .title = "Right side hidden: error of the anchor",
              .x_label = "hidden part of the first nosing [%]",
              .y_label = "mean distance from the true place [mm]"};
  for (const double distance : kDistances_m) {
    Curve anchor{.name = fmt::format("dynamic anchor, {:.0f} m", distance)};
    Curve middle{.name = fmt::format("middle, {:.0f} m", distance)};
    for (std::size_t i = 0; i < places.size(); ++i) {
      if (places[i].distance_m != distance) continue;
      for (const auto& [curve, quantity] : {std::pair{&anchor, kAnchorError}, std::pair{&middle, kMiddleError}}) {
        const Spread spread = absolute_error(outcomes[i], quantity);
        curve->add(100.0 * places[i].hidden_share, spread.mean, spread.deviation);
      }
    }
    chart.curves.push_back(std::move(anchor));
    chart.curves.push_back(std::move(middle));
  }
  chart.curves.push_back({.name = "the paper, 28 mm (one scene)",
                          .x = {100.0 * std::begin(kHiddenShares)[0], 100.0 * std::end(kHiddenShares)[-1]},
                          .y = {kPaperError_mm, kPaperError_mm},
                          .from_paper = true});
  return chart;
}

}  // namespace

Result run_occlusion(const Request& request) {
  const auto sweeps = static_cast<std::size_t>(shared_count(kSweeps, request.share));
  std::vector<Place> places = all_places();
  const double left = std::min(1.0, request.share * kSweeps);
  places.resize(static_cast<std::size_t>(shared_count(static_cast<int>(places.size()), left)));
  const std::vector<std::vector<Outcome>> outcomes = measure(places, sweeps, request);
  return {
      .tables = {make_table(places, outcomes)},
      .charts = {make_chart(places, outcomes)},
      .notes = {"A wall across the hall, half way between the robot and stairway III (railings on both sides), hides "
                "the stated part of its first nosing from the right; the sight line from the disk axis counts.",
                "The anchor is compared with the true end of the first nosing that its side names; middle compares, "
                "for the same answers, the middle of the first nosing as an anchor that does not look for railings "
                "would. Distances are horizontal.",
                "The paper states one error, 28 mm, for one scene whose dimensions it does not give."}};
}

}  // namespace stairway::evaluation
