// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "tools/evaluation/accuracy.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "tools/evaluation/accuracy_run.hpp"
#include "tools/evaluation/error_quantity.hpp"
#include "tools/evaluation/parallel_runs.hpp"

namespace stairway::evaluation {
namespace {

constexpr int kScenesPerCase = 40;
constexpr int kRooms = 100;

/// An error with all that stands beside it.
struct Figure {
  ErrorQuantity error;
  std::optional<double> AccuracyTargets::*target;
  double AccuracyBound::*bound;     ///< none for what has no bound
  double detect::Stairway::*sigma;  ///< none for what the detector states none of
};

constexpr Figure kHeight{kHeightError, &AccuracyTargets::height_mm, &AccuracyBound::height_m,
                         &detect::Stairway::step_height_sigma};
constexpr Figure kDepth{kDepthError, &AccuracyTargets::depth_mm, &AccuracyBound::depth_m,
                        &detect::Stairway::step_depth_sigma};
constexpr Figure kHeading{kHeadingError, &AccuracyTargets::heading_deg, &AccuracyBound::heading_rad,
                          &detect::Stairway::heading_sigma};
constexpr Figure kWidth{kWidthError, &AccuracyTargets::width_mm, &AccuracyBound::width_m,
                        &detect::Stairway::width_sigma};
constexpr Figure kTurn{kTurnError, &AccuracyTargets::turn_deg, nullptr, nullptr};
constexpr Figure kAlong{kAlongError, &AccuracyTargets::along_mm, &AccuracyBound::along_m, nullptr};
constexpr Figure kAcross{kAcrossError, &AccuracyTargets::across_mm, &AccuracyBound::across_m, nullptr};
constexpr std::array kFigures{kHeight, kDepth, kHeading, kTurn, kWidth, kAlong, kAcross};
constexpr std::array kStated{kHeight, kDepth, kHeading, kWidth};

struct Measured {
  const AccuracyCase* of;
  std::vector<AccuracyRun> runs;

  std::vector<Outcome> outcomes() const {
    std::vector<Outcome> result;
    for (const AccuracyRun& run : runs) result.push_back(run.outcome);
    return result;
  }
};

Measured measure(const AccuracyCase& wanted, int scenes, const Request& request, double done, double part) {
  Request of_case = request;
  if (request.progress)
    of_case.progress = [&](double share, std::string_view next) { request.progress(done + part * share, next); };
  const auto run = [&](std::size_t i) { return run_accuracy_case(wanted, request, i); };
  const auto name_of = [&](std::size_t i) { return fmt::format("{}, scene {}", wanted.name, request.seed + i); };
  return {.of = &wanted, .runs = run_with_progress(of_case, static_cast<std::size_t>(scenes), run, name_of)};
}

int scenes_of(const AccuracyCase& wanted, const Request& request) {
  if (request.scenes > 0 && wanted.has_stairs()) return request.scenes;
  return shared_count(wanted.has_stairs() ? kScenesPerCase : kRooms, request.share);
}

std::vector<Measured> measure_all(const Request& request) {
  double all = 0.0;
  for (const AccuracyCase& wanted : accuracy_cases()) all += scenes_of(wanted, request);
  std::vector<Measured> result;
  double done = 0.0;
  for (const AccuracyCase& wanted : accuracy_cases()) {
    const int scenes = scenes_of(wanted, request);
    result.push_back(measure(wanted, scenes, request, done / all, scenes / all));
    done += scenes;
  }
  return result;
}

// A normal distribution's mean absolute value over its standard deviation.
const double kMeanPerSigma = std::sqrt(2.0 / std::numbers::pi);

using Number = std::optional<double>;

Cell cell(const Number& number) {
  Cell result;
  if (number) result = *number;
  return result;
}

Number mean(const std::vector<double>& values) { return values.empty() ? Number() : Number(spread_of(values).mean); }

Number mean_bound(const Measured& measured, const Figure& figure) {
  if (figure.bound == nullptr) return std::nullopt;
  std::vector<double> values;
  for (const AccuracyRun& run : measured.runs)
    if (run.bound) values.push_back(figure.error.factor * kMeanPerSigma * (*run.bound).*figure.bound);
  return mean(values);
}

Number target(const Measured& measured, const Figure& figure) { return measured.of->targets.*figure.target; }

Number percent(double part, std::size_t whole) {
  return whole > 0 ? Number(100.0 * part / static_cast<double>(whole)) : Number();
}

Table found_table(const std::vector<Measured>& all) {
  Table table{.name = "accuracy-found",
              .title = "Stairways found",
              .columns = {{"case", ""},
                          {"runs", "", 0},
                          {"found", "%", 1},
                          {"found_target", "%", 0},
                          {"right_kind", "", 0},
                          {"right_direction", "", 0},
                          {"right_steps", "", 0},
                          {"false", "", 0}},
              .rows = {}};
  for (const Measured& measured : all) {
    const std::vector<Outcome> outcomes = measured.outcomes();
    std::vector<Cell> row{std::string(measured.of->name), static_cast<double>(measured.runs.size())};
    if (measured.of->has_stairs()) {
      row.push_back(cell(percent(found_count(outcomes), outcomes.size())));
      row.emplace_back(measured.of->targets.found_percent);
      row.emplace_back(static_cast<double>(found_count(outcomes, &StairwayError::is_right_kind)));
      row.emplace_back(static_cast<double>(found_count(outcomes, &StairwayError::is_right_direction)));
      row.emplace_back(static_cast<double>(right_step_count(outcomes)));
    } else {
      row.resize(row.size() + 5);
    }
    row.emplace_back(static_cast<double>(false_count(outcomes)));
    table.rows.push_back(std::move(row));
  }
  return table;
}

Table error_table(const std::vector<Measured>& all) {
  Table table{.name = "accuracy-errors",
              .title = "Mean absolute errors, what is wanted, and what the sensor allows",
              .columns = {{"case", ""}},
              .rows = {}};
  for (const Figure& figure : kFigures) {
    const std::string name = figure.error.name;
    table.columns.push_back({name + "_error", figure.error.unit, std::max(2, figure.error.digits)});
    table.columns.push_back({name + "_target", figure.error.unit, 2});
    if (figure.bound != nullptr) table.columns.push_back({name + "_bound", figure.error.unit, 3});
  }
  for (const Measured& measured : all) {
    if (!measured.of->has_stairs()) continue;
    std::vector<Cell> row{std::string(measured.of->name)};
    const std::vector<Outcome> outcomes = measured.outcomes();
    for (const Figure& figure : kFigures) {
      row.emplace_back(absolute_error(outcomes, figure.error).mean);
      row.push_back(cell(target(measured, figure)));
      if (figure.bound != nullptr) row.push_back(cell(mean_bound(measured, figure)));
    }
    table.rows.push_back(std::move(row));
  }
  return table;
}

std::vector<double> squared_ratios(const Measured& measured, const Figure& figure) {
  std::vector<double> ratios;
  for (const AccuracyRun& run : measured.runs) {
    if (!run.found || !run.outcome.error) continue;
    const double sigma = (*run.found).*figure.sigma;
    if (sigma > 0.0) ratios.push_back(std::pow(figure.error.of(*run.outcome.error) / sigma, 2));
  }
  return ratios;
}

Table sigma_table(const std::vector<Measured>& all) {
  Table table{
      .name = "accuracy-sigmas",
      .title = "Squared errors over the variances stated: mean (1 is honest) and share within two sigmas (95 %)",
      .columns = {{"case", ""}},
      .rows = {}};
  for (const Figure& figure : kStated) {
    table.columns.push_back({std::string(figure.error.name) + "_squared", "", 2});
    table.columns.push_back({std::string(figure.error.name) + "_within", "%", 0});
  }
  for (const Measured& measured : all) {
    if (!measured.of->has_stairs()) continue;
    std::vector<Cell> row{std::string(measured.of->name)};
    for (const Figure& figure : kStated) {
      const std::vector<double> ratios = squared_ratios(measured, figure);
      const auto within = std::count_if(ratios.begin(), ratios.end(), [](double ratio) { return ratio < 4.0; });
      row.push_back(cell(mean(ratios)));
      row.push_back(cell(percent(static_cast<double>(within), ratios.size())));
    }
    table.rows.push_back(std::move(row));
  }
  return table;
}

Table step_table(const std::vector<Measured>& all) {
  Table table{.name = "accuracy-steps",
              .title = "Height of every single step seen: mean absolute error; and flights that are called irregular",
              .columns = {{"case", ""},
                          {"steps", "", 0},
                          {"step_height_error", "mm", 2},
                          {"step_height_target", "mm", 2},
                          {"called_irregular", "%", 1}},
              .rows = {}};
  for (const Measured& measured : all) {
    if (!measured.of->has_stairs()) continue;
    std::vector<double> errors;
    std::size_t found = 0;
    double irregular = 0.0;
    for (const AccuracyRun& run : measured.runs) {
      for (const double error : run.step_height_errors_m) errors.push_back(kMillimetres * std::abs(error));
      if (!run.found) continue;
      ++found;
      irregular += run.found->is_irregular ? 1.0 : 0.0;
    }
    table.rows.push_back({std::string(measured.of->name), static_cast<double>(errors.size()), cell(mean(errors)),
                          cell(measured.of->targets.step_height_mm), cell(percent(irregular, found))});
  }
  return table;
}

Chart error_chart(const std::vector<Measured>& all, const Figure& figure) {
  Chart chart{.name = fmt::format("accuracy-{}", figure.error.name),
              .title = fmt::format("Error of the {}, and what the sensor allows", figure.error.name),
              .y_label = fmt::format("mean absolute error [{}]", figure.error.unit),
              .logarithmic = true};
  Curve measured_curve{.name = "measured"};
  Curve wanted_curve{.name = "wanted"};
  Curve bound_curve{.name = "bound"};
  constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
  for (const Measured& measured : all) {
    if (!measured.of->has_stairs()) continue;
    const auto x = static_cast<double>(chart.categories.size());
    measured_curve.add(x, absolute_error(measured.outcomes(), figure.error).mean);
    wanted_curve.add(x, target(measured, figure).value_or(kUnknown));
    bound_curve.add(x, mean_bound(measured, figure).value_or(kUnknown));
    chart.categories.emplace_back(measured.of->name);
  }
  chart.curves = {std::move(measured_curve), std::move(wanted_curve), std::move(bound_curve)};
  return chart;
}

}  // namespace

Result run_accuracy(const Request& request) {
  const std::vector<Measured> all = measure_all(request);
  Result result{
      .tables = {found_table(all), error_table(all), sigma_table(all), step_table(all)}, .charts = {}, .notes = {}};
  for (const Figure& figure : {kHeight, kDepth, kHeading, kWidth}) result.charts.push_back(error_chart(all, figure));
  result.notes = {
      "Furnished rooms. closed: 0.5 to 6.5 m, 5 to 12 steps; open: boards without risers up to 4.5 m, open-far from "
      "there to 6 m; tilted: the closed ones from a robot rolled and pitched by up to 3 degrees that does not know; "
      "descending: from the upper edge, inverted mount; biased: the closed ones with 10 mm on every range; fast: a "
      "turn in 5 s, up to 4 m; irregular: every nosing off by 12 mm (one standard deviation), at 3 m; rooms: none.",
      "Errors are means of absolute values over the stairways found, of the place of the anchor along and across the "
      "ascent. Compare them with what was found.",
      "The bound is that of Cramer and Rao for each scene, with mixed pixels left out, as the mean absolute error of "
      "the best estimate: 0.8 of its standard deviation. A method that models mixed pixels can do better, one that "
      "does not know the attitude or the bias worse.",
  };
  return result;
}

}  // namespace stairway::evaluation
