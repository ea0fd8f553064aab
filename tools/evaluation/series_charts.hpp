// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string_view>
#include <vector>

#include "detector/competition.hpp"
#include "tools/evaluation/experiment.hpp"
#include "tools/evaluation/stairway_error.hpp"

namespace stairway::evaluation {

struct NamedStrategy {
  detect::Strategy strategy;
  std::string_view name;
};
/// The strategies of the series: the paper's, and ours.
inline constexpr std::array<NamedStrategy, 2> kSeriesStrategies{
    {{detect::Strategy::Optimizing, "optimizing"}, {detect::Strategy::Joint, "joint"}}};

/// What one strategy found at one place.
struct SeriesPlace {
  std::size_t stairway = 0;  ///< 0 is I, 1 is III
  std::size_t strategy = 0;  ///< index into kSeriesStrategies
  double distance_m = 0.0;
  std::vector<Outcome> outcomes;
};

/// Errors in height, depth, width and pitch, by strategy and distance.
Table coefficient_table(std::size_t stairway, const std::vector<SeriesPlace>& places);
/// Errors of the anchor along and across the stairway.
Table localisation_table(std::size_t stairway, const std::vector<SeriesPlace>& places);
/// Table 2: all places but those of I beyond 4 m, which the paper leaves out, beside the paper's figures.
Table comparison_table(const std::vector<SeriesPlace>& places);
/// Fig 18 a and b, or c and d.
std::vector<Chart> series_charts(std::size_t stairway, const std::vector<SeriesPlace>& places);
/// How many were found, over the distance.
Chart detection_chart(const std::vector<SeriesPlace>& places);

}  // namespace stairway::evaluation
