// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "tools/evaluation/series_charts.hpp"

#include <fmt/format.h>

#include <array>
#include <ranges>
#include <span>

#include "tools/evaluation/error_quantity.hpp"
#include "tools/evaluation/measurement_series.hpp"

namespace stairway::evaluation {
namespace {

constexpr double kPaperLast_I_m = 4.5;  // where the paper found 4 of 10
constexpr double kPaperCoefficientBound_mm = 7.0;
constexpr double kPaperPlaceBound_mm = 50.0;

constexpr std::array kCoefficients{kHeightError, kDepthError, kWidthError, kPitchError};
constexpr std::array kPlaceErrors{kAlongError, kAcrossError};

std::string_view name_of(std::size_t stairway) { return series_stairway(stairway).name; }

std::vector<Cell> head(const SeriesPlace& place) {
  return {std::string(kSeriesStrategies[place.strategy].name), place.distance_m,
          static_cast<double>(place.outcomes.size()), static_cast<double>(found_count(place.outcomes))};
}

Cell paper_found(const SeriesPlace& place) {
  if (place.stairway == 0 && place.distance_m == kPaperLast_I_m && place.strategy == 0) return std::string("4 of 10");
  return {};
}

bool is_in_paper(const SeriesPlace& place) { return place.stairway == 1 || place.distance_m < kPaperLast_I_m; }

/// The places of one strategy at one stairway.
auto places_of(std::size_t stairway, std::size_t strategy, const std::vector<SeriesPlace>& places) {
  return places | std::views::filter([=](const SeriesPlace& place) {
           return place.stairway == stairway && place.strategy == strategy;
         });
}

/// Mean error over the distance, one curve per strategy and quantity.
std::vector<Curve> curves(std::size_t stairway, const std::vector<SeriesPlace>& places,
                          std::span<const ErrorQuantity> quantities) {
  std::vector<Curve> result;
  for (std::size_t s = 0; s < kSeriesStrategies.size(); ++s) {
    for (const ErrorQuantity& quantity : quantities) {
      Curve curve{.name = fmt::format("{}, {}", quantity.name, kSeriesStrategies[s].name)};
      for (const SeriesPlace& place : places_of(stairway, s, places)) {
        const Spread spread = absolute_error(place.outcomes, quantity);
        curve.add(place.distance_m, spread.mean, spread.deviation);
      }
      result.push_back(std::move(curve));
    }
  }
  return result;
}

Curve bound(std::size_t stairway, const std::vector<SeriesPlace>& places, double bound_mm) {
  Curve curve{.name = fmt::format("the paper: at most {:.0f} mm", bound_mm), .from_paper = true};
  for (const SeriesPlace& place : places_of(stairway, 0, places))
    if (is_in_paper(place)) curve.add(place.distance_m, bound_mm);
  return curve;
}

std::vector<Cell> own_row(std::size_t strategy, const std::vector<SeriesPlace>& places) {
  std::vector<Outcome> all;
  for (const SeriesPlace& place : places)
    if (place.strategy == strategy && is_in_paper(place))
      all.insert(all.end(), place.outcomes.begin(), place.outcomes.end());
  std::vector<Cell> row{fmt::format("here, {}", kSeriesStrategies[strategy].name)};
  append_errors(row, all, kCoefficients);
  return row;
}

}  // namespace

Table coefficient_table(std::size_t stairway, const std::vector<SeriesPlace>& places) {
  Table table{.name = fmt::format("series-{}-coefficients", name_of(stairway)),
              .title = fmt::format("Stairway {}: errors of the coefficients over the distance (Fig 18 {})",
                                   name_of(stairway), stairway == 0 ? "a" : "c"),
              .columns = {{"strategy", ""},
                          {"distance", "m", 1},
                          {"runs", "", 0},
                          {"found", "", 0},
                          {"paper_found", ""},
                          {"right_steps", "", 0},
                          {"false", "", 0}},
              .rows = {}};
  append_error_columns(table.columns, kCoefficients);
  table.columns.push_back({"paper_bound", "mm", 0});
  for (const SeriesPlace& place : places) {
    if (place.stairway != stairway) continue;
    std::vector<Cell> row = head(place);
    row.push_back(paper_found(place));
    row.emplace_back(static_cast<double>(right_step_count(place.outcomes)));
    row.emplace_back(static_cast<double>(false_count(place.outcomes)));
    append_errors(row, place.outcomes, kCoefficients);
    row.push_back(is_in_paper(place) ? Cell(kPaperCoefficientBound_mm) : Cell());
    table.rows.push_back(std::move(row));
  }
  return table;
}

Table localisation_table(std::size_t stairway, const std::vector<SeriesPlace>& places) {
  Table table{.name = fmt::format("series-{}-localisation", name_of(stairway)),
              .title = fmt::format("Stairway {}: errors of the anchor over the distance (Fig 18 {})", name_of(stairway),
                                   stairway == 0 ? "b" : "d"),
              .columns = {{"strategy", ""}, {"distance", "m", 1}, {"runs", "", 0}, {"found", "", 0}},
              .rows = {}};
  append_error_columns(table.columns, kPlaceErrors);
  table.columns.push_back({"largest_distance", "mm", 1});
  table.columns.push_back({"paper_bound", "mm", 0});
  for (const SeriesPlace& place : places) {
    if (place.stairway != stairway) continue;
    std::vector<Cell> row = head(place);
    append_errors(row, place.outcomes, kPlaceErrors);
    row.emplace_back(absolute_error(place.outcomes, kAnchorError).largest);
    row.push_back(is_in_paper(place) ? Cell(kPaperPlaceBound_mm) : Cell());
    table.rows.push_back(std::move(row));
  }
  return table;
}

Table comparison_table(const std::vector<SeriesPlace>& places) {
  Table table{.name = "table-2",
              .title = "Mean errors and standard deviations of both series, I beyond 4 m left out (Table 2)",
              .columns = {{"method", ""}},
              .rows = {}};
  append_error_columns(table.columns, kCoefficients);
  for (std::size_t s = 0; s < kSeriesStrategies.size(); ++s) table.rows.push_back(own_row(s, places));
  const auto stated = [&](const char* method, const std::vector<Cell>& figures) {
    table.rows.push_back({std::string(method)});
    table.rows.back().insert(table.rows.back().end(), figures.begin(), figures.end());
  };
  const Cell none;
  stated("paper", {2.5, 2.3, 2.5, 3.3, 35.5, 33.1, 0.26, 0.50});
  stated("paper, its IROS 2016", {3.6, 4.5, 5.7, 6.4, 21.7, 39.5, 0.98, 1.11});
  stated("paper, Harms 2015 (SV)", {1.2, 6.6, 2.4, 11.4, 194.3, 108.0, 0.09, 1.28});
  stated("paper, Delmerico 2013 (RGB-D)", {17.0, 14.0, 12.0, 16.0, 173.0, 128.0, 2.3, 1.9});
  stated("paper, Osswald 2011 (TPRS)", {4.2, 3.3, 11.7, 6.7, 34.0, 19.5, none, none});
  stated("paper, Osswald 2011 (SLG)", {6.8, 5.4, 9.0, 6.1, 22.5, 19.7, none, none});
  return table;
}

std::vector<Chart> series_charts(std::size_t stairway, const std::vector<SeriesPlace>& places) {
  const std::string_view name = name_of(stairway);
  Chart coefficients{.name = fmt::format("series-{}-coefficients", name),
                     .title = fmt::format("Stairway {}: errors of height and depth", name),
                     .x_label = "distance of the first nosing [m]",
                     .y_label = "mean absolute error [mm]",
                     .curves = curves(stairway, places, std::span(kCoefficients).first<2>())};
  coefficients.curves.push_back(bound(stairway, places, kPaperCoefficientBound_mm));
  Chart place{.name = fmt::format("series-{}-localisation", name),
              .title = fmt::format("Stairway {}: errors of the anchor", name),
              .x_label = "distance of the first nosing [m]",
              .y_label = "mean absolute error [mm]",
              .curves = curves(stairway, places, kPlaceErrors)};
  place.curves.push_back(bound(stairway, places, kPaperPlaceBound_mm));
  return {std::move(coefficients), std::move(place)};
}

Chart detection_chart(const std::vector<SeriesPlace>& places) {
  Chart chart{.name = "series-found",
              .title = "Stairways found over the distance",
              .x_label = "distance of the first nosing [m]",
              .y_label = "found [%]"};
  for (const std::size_t stairway : {0U, 1U}) {
    for (std::size_t s = 0; s < kSeriesStrategies.size(); ++s) {
      Curve curve{.name = fmt::format("{}, {}", name_of(stairway), kSeriesStrategies[s].name)};
      for (const SeriesPlace& place : places_of(stairway, s, places)) {
        curve.add(place.distance_m, 100.0 * found_count(place.outcomes) / static_cast<double>(place.outcomes.size()),
                  0.0);  // sets the curves apart
      }
      chart.curves.push_back(std::move(curve));
    }
  }
  chart.curves.push_back({.name = "I, the paper", .x = {kPaperLast_I_m}, .y = {40.0}, .from_paper = true});
  return chart;
}

}  // namespace stairway::evaluation
