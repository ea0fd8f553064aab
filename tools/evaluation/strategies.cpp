// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "tools/evaluation/strategies.hpp"

#include <fmt/format.h>

#include <array>

#include "tools/evaluation/error_quantity.hpp"
#include "tools/evaluation/measurement_series.hpp"
#include "tools/evaluation/parallel_runs.hpp"
#include "tools/evaluation/stage_costs.hpp"
#include "tools/evaluation/stairway_error.hpp"

namespace stairway::evaluation {
namespace {

constexpr double kShareOfSeries = 0.5;
constexpr std::size_t kEveryPlace = 2;
constexpr double kMilliseconds = 1e3;
constexpr std::array kErrors{kHeightError, kDepthError};

struct StrategyRow {
  detect::Strategy strategy;
  const char* name;
  Cell paper_ms;  ///< Fig 20
};
const std::array<StrategyRow, 4>& strategies() {
  static const std::array<StrategyRow, 4> rows{{{detect::Strategy::Greedy, "greedy", 400.0},
                                                {detect::Strategy::Thorough, "thorough", 900.0},
                                                {detect::Strategy::Optimizing, "optimizing", 950.0},
                                                {detect::Strategy::Joint, "joint", {}}}};
  return rows;
}

struct Trial {
  Outcome outcome;
  double graph_s = 0.0;  ///< initialisation, extension, competition
  double fit_s = 0.0;    ///< to the points; the paper has none
};
using Trials = std::array<Trial, 4>;

Trials try_all(const SeriesRun& run, const Request& request) {
  const SeriesSweep sweep = simulate_run(run, request, 1);
  Trials trials;
  for (std::size_t i = 0; i < trials.size(); ++i) {
    detect::DetectorOptions options = request.settings.detector;
    options.competition.strategy = strategies()[i].strategy;
    StageCosts costs;
    const detect::Detection detection = detect::detect_stairways(sweep.cloud, options, costs.listener());
    costs.stop();
    trials[i] = {outcome_of(detection, sweep.truths), costs.seconds("stair_graph"), costs.seconds("fit")};
  }
  return trials;
}

/// What one strategy did at one stairway, or at both.
struct Group {
  std::vector<Outcome> outcomes;
  std::vector<double> graph_ms;
  std::vector<double> fit_ms;

  void add(const Trial& trial) {
    outcomes.push_back(trial.outcome);
    graph_ms.push_back(kMilliseconds * trial.graph_s);
    fit_ms.push_back(kMilliseconds * trial.fit_s);
  }
};
using Groups = std::array<std::array<Group, 4>, 2>;  // by stairway and strategy

Groups measure(const Request& request) {
  const std::vector<SeriesRun> runs = series_runs(kShareOfSeries * request.share, kEveryPlace);
  const auto trials = run_with_progress(
      request, runs.size(), [&](std::size_t i) { return try_all(runs[i], request); },
      [&](std::size_t i) { return runs[i].description(); });
  Groups groups;
  for (std::size_t i = 0; i < runs.size(); ++i)
    for (std::size_t s = 0; s < trials[i].size(); ++s) groups[runs[i].stairway][s].add(trials[i][s]);
  return groups;
}

Table error_table(const Groups& groups) {
  Table table{
      .name = "strategies",
      .title = "Errors and processor time of the competing initialisations (Figs 19 and 20)",
      .columns = {{"stairway", ""}, {"strategy", ""}, {"runs", "", 0}, {"found", "", 0}, {"right_steps", "", 0}},
      .rows = {}};
  append_error_columns(table.columns, kErrors);
  table.columns.insert(
      table.columns.end(),
      {{"graph_time", "ms", 2}, {"graph_time_sd", "ms", 2}, {"fit_time", "ms", 2}, {"paper_graph_time", "ms", 0}});
  for (std::size_t stairway = 0; stairway < groups.size(); ++stairway) {
    for (std::size_t s = 0; s < strategies().size(); ++s) {
      const Group& group = groups[stairway][s];
      const Spread graph = spread_of(group.graph_ms);
      std::vector<Cell> row{
          std::string(series_stairway(stairway).name), strategies()[s].name, static_cast<double>(group.outcomes.size()),
          static_cast<double>(found_count(group.outcomes)), static_cast<double>(right_step_count(group.outcomes))};
      append_errors(row, group.outcomes, kErrors);
      row.insert(row.end(), {graph.mean, graph.deviation, spread_of(group.fit_ms).mean, strategies()[s].paper_ms});
      table.rows.push_back(std::move(row));
    }
  }
  return table;
}

Chart error_chart(const Groups& groups) {
  Chart chart{.name = "strategies-errors",
              .title = "Errors of the competing initialisations",
              .y_label = "mean absolute error [mm]",
              .categories = {"I: height", "I: depth", "III: height", "III: depth"}};
  for (std::size_t s = 0; s < strategies().size(); ++s) {
    Curve curve{.name = strategies()[s].name};
    for (const auto& of_stairway : groups) {
      for (const ErrorQuantity& quantity : kErrors) {
        const Spread spread = absolute_error(of_stairway[s].outcomes, quantity);
        curve.add(static_cast<double>(curve.x.size()), spread.mean, spread.deviation);
      }
    }
    chart.curves.push_back(std::move(curve));
  }
  return chart;
}

Chart time_chart(const Groups& groups) {
  Chart chart{.name = "strategies-time",
              .title = "Time of the graph and of the fit",
              .y_label = "processor time [ms]",
              .categories = {},
              .curves = {{.name = "graph, here"},
                         {.name = "fit to the points, here"},
                         {.name = "graph, the paper", .from_paper = true}}};
  for (std::size_t s = 0; s < strategies().size(); ++s) {
    chart.categories.emplace_back(strategies()[s].name);
    std::vector<double> graph, fit;
    for (const auto& of_stairway : groups) {
      graph.insert(graph.end(), of_stairway[s].graph_ms.begin(), of_stairway[s].graph_ms.end());
      fit.insert(fit.end(), of_stairway[s].fit_ms.begin(), of_stairway[s].fit_ms.end());
    }
    const auto at = static_cast<double>(s);
    chart.curves[0].add(at, spread_of(graph).mean);
    if (strategies()[s].strategy == detect::Strategy::Joint) chart.curves[1].add(at, spread_of(fit).mean);
    if (const auto* paper = std::get_if<double>(&strategies()[s].paper_ms)) chart.curves[2].add(at, *paper);
  }
  return chart;
}

}  // namespace

Result run_strategies(const Request& request) {
  const Groups groups = measure(request);
  return {
      .tables = {error_table(groups)},
      .charts = {error_chart(groups), time_chart(groups)},
      .notes = {"The sweeps are some of those of the experiment series: every metre from 0.5 to 6.5 m, five at each "
                "place; see there for the stairways.",
                "Of Fig 19 the paper's text only says that greedy is considerably worse, thorough better, and "
                "optimizing best in almost all cases; joint is not in the paper.",
                "Times are processor time of the one thread that detects; several sweeps are worked on at once. "
                "graph is the stage stair_graph: initialisation, extension, confirmation and competition, and the "
                "optimisation of eq 20. fit is the joint fit to the points. The paper does not name its computer."}};
}

}  // namespace stairway::evaluation
