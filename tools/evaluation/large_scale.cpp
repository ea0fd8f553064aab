// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "tools/evaluation/large_scale.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "tools/evaluation/error_quantity.hpp"
#include "tools/evaluation/measurement_series.hpp"
#include "tools/evaluation/peak_memory.hpp"
#include "tools/evaluation/stage_costs.hpp"
#include "tools/evaluation/stairway_error.hpp"
#include "tools/sim/building.hpp"

namespace stairway::evaluation {
namespace {

/// A robot that stops often takes shorter sweeps.
constexpr double kPeriodShare = 0.15;

struct Size {
  sim::BuildingSpec building;
  std::size_t max_stands;
};

constexpr std::size_t kAllStands = 1000;
const std::array<Size, 5>& sizes() {
  static const std::array<Size, 5> all{{{{.storeys = 1, .rooms = 2, .stairwells = 0}, 1},
                                        {{.storeys = 1, .rooms = 2, .stairwells = 0}, kAllStands},
                                        {{.storeys = 2, .rooms = 2, .stairwells = 1}, kAllStands},
                                        {{.storeys = 3, .rooms = 3, .stairwells = 1}, kAllStands},
                                        {{.storeys = 3, .rooms = 5, .stairwells = 1}, kAllStands}}};
  return all;
}

struct Measured {
  sim::BuildingSpec spec;
  std::size_t stands = 0;
  std::size_t points = 0;
  std::vector<Outcome> outcomes;  ///< one per flight
  int false_count = 0;
  double time_s = 0.0;
  double graph_s = 0.0;
  double growth_MB = 0.0;
};

Measured measure(const Size& size, const Request& request) {
  sim::BuildingSpec spec = size.building;
  spec.seed = request.seed;
  const sim::Building building = sim::build_building(spec);
  const std::span stands = std::span(building.stands).first(std::min(building.stands.size(), size.max_stands));
  const sim::SweepOptions sweep{.disk_period_s = kPeriodShare * request.settings.disk.period_s};
  const scan::PointCloud cloud =
      sim::simulate_merged(building.scene, stands, request.settings.mount, {}, sweep, request.seed);
  Measured measured{.spec = spec, .stands = stands.size(), .points = cloud.points.size()};
  StageCosts costs;
  const PeakMemory memory;
  const detect::Detection detection = detect::detect_stairways(cloud, request.settings.detector, costs.listener());
  costs.stop();
  measured.growth_MB = memory.growth_MB();
  measured.time_s = costs.total_s();
  measured.graph_s = costs.seconds("stair_graph");
  for (std::size_t i = 0; i < building.scene.truths.size(); ++i)
    measured.outcomes.push_back(outcome_of(detection, building.scene.truths, i));
  measured.false_count = static_cast<int>(detection.stairways.size()) - found_count(measured.outcomes);
  return measured;
}

Table make_table(const std::vector<Measured>& all) {
  Table table{.name = "large-scale",
              .title = "Buildings merged from many sweeps (Fig 21)",
              .columns = {{"storeys", "", 0},
                          {"sweeps", "", 0},
                          {"points", "million", 2},
                          {"flights", "", 0},
                          {"found", "", 0},
                          {"right_steps", "", 0},
                          {"false", "", 0},
                          {"height_error", "mm", 2},
                          {"depth_error", "mm", 2},
                          {"time", "s", 2},
                          {"graph_time", "s", 3},
                          {"peak_growth", "MB", 0},
                          {"growth_per_point", "byte", 0}},
              .rows = {}};
  for (const Measured& m : all) {
    const auto points = static_cast<double>(m.points);
    table.rows.push_back({static_cast<double>(m.spec.storeys), static_cast<double>(m.stands), 1e-6 * points,
                          static_cast<double>(m.outcomes.size()), static_cast<double>(found_count(m.outcomes)),
                          static_cast<double>(right_step_count(m.outcomes)), static_cast<double>(m.false_count),
                          absolute_error(m.outcomes, kHeightError).mean, absolute_error(m.outcomes, kDepthError).mean,
                          m.time_s, m.graph_s, m.growth_MB, m.growth_MB * 1024.0 * 1024.0 / points});
  }
  return table;
}

Chart growth_chart(const std::vector<Measured>& all, const char* name, const char* title, const char* y_label,
                   double Measured::*quantity) {
  Chart chart{.name = name, .title = title, .x_label = "points", .y_label = y_label, .logarithmic = true};
  Curve measured{.name = "measured"}, linear{.name = "in proportion to the points", .from_paper = true};
  for (const Measured& m : all) {
    const auto points = static_cast<double>(m.points);
    measured.add(points, m.*quantity);
    linear.add(points, measured.y.front() * points / measured.x.front());
  }
  chart.curves = {std::move(measured), std::move(linear)};
  return chart;
}

}  // namespace

Result run_large_scale(const Request& request) {
  std::vector<Measured> all;
  const int count = shared_count(static_cast<int>(sizes().size()), request.share);
  for (int i = 0; i < count; ++i) {
    const Size& size = sizes()[static_cast<std::size_t>(i)];
    // Every building takes about as long as all smaller ones together.
    if (request.progress)
      request.progress(i == 0 ? 0.0 : std::pow(2.0, i - count), fmt::format("{} storeys", size.building.storeys));
    all.push_back(measure(size, request));
  }
  return {.tables = {make_table(all)},
          .charts = {growth_chart(all, "large-scale-time", "Time to detect in a building", "processor time [s]",
                                  &Measured::time_s),
                     growth_chart(all, "large-scale-memory", "Memory to detect in a building", "peak growth [MB]",
                                  &Measured::growth_MB)},
          .notes = {"Every building is one cloud, merged without error from sweeps in its corridors and at the foot of "
                    "every flight; such a cloud has no single place of the sensor. Sweeps take 15 % of "
                    "disk.period_s.",
                    "Time is processor time of the one thread that detects. Peak growth is what the process holds "
                    "beyond the cloud itself. In the charts the dashed line is no measurement: it grows in proportion "
                    "to the points from the first one.",
                    "The paper shows one such building and states no figures."}};
}

}  // namespace stairway::evaluation
