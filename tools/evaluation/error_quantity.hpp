// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <numbers>
#include <span>
#include <vector>

#include "tools/evaluation/experiment.hpp"
#include "tools/evaluation/spread.hpp"
#include "tools/evaluation/stairway_error.hpp"

namespace stairway::evaluation {

inline constexpr double kMillimetres = 1e3;
inline constexpr double kDegrees = 180.0 / std::numbers::pi;

/// An error of the stairways found, as tables and charts show it.
struct ErrorQuantity {
  const char* name;  ///< machine-readable; "height" has the columns height_error and height_sd
  const char* unit;
  int digits;
  double factor;  ///< to the unit
  double (*of)(const StairwayError& error);
};

inline constexpr ErrorQuantity kHeightError{"height", "mm", 2, kMillimetres,
                                            [](const StairwayError& e) { return e.height_m; }};
inline constexpr ErrorQuantity kDepthError{"depth", "mm", 2, kMillimetres,
                                           [](const StairwayError& e) { return e.depth_m; }};
inline constexpr ErrorQuantity kWidthError{"width", "mm", 1, kMillimetres,
                                           [](const StairwayError& e) { return e.width_m; }};
inline constexpr ErrorQuantity kPitchError{"pitch", "deg", 2, kDegrees,
                                           [](const StairwayError& e) { return e.pitch_rad; }};
inline constexpr ErrorQuantity kTurnError{"turn", "deg", 2, kDegrees,
                                          [](const StairwayError& e) { return e.turn_rad; }};
inline constexpr ErrorQuantity kHeadingError{"heading", "deg", 2, kDegrees,
                                             [](const StairwayError& e) { return e.heading_rad; }};
inline constexpr ErrorQuantity kAlongError{"along", "mm", 1, kMillimetres,
                                           [](const StairwayError& e) { return e.along_m; }};
inline constexpr ErrorQuantity kAcrossError{"across", "mm", 1, kMillimetres,
                                            [](const StairwayError& e) { return e.across_m; }};
inline constexpr ErrorQuantity kAnchorError{"anchor", "mm", 1, kMillimetres,
                                            [](const StairwayError& e) { return e.anchor_m(); }};
inline constexpr ErrorQuantity kMiddleError{"middle", "mm", 1, kMillimetres,
                                            [](const StairwayError& e) { return e.middle_m; }};

/// Mean and deviation of the absolute value of an error, over those that were found; in the quantity's unit.
Spread absolute_error(std::span<const Outcome> outcomes, const ErrorQuantity& quantity);

/// Of each quantity the columns of mean and standard deviation.
void append_error_columns(std::vector<Column>& columns, std::span<const ErrorQuantity> quantities);
/// The cells of those columns.
void append_errors(std::vector<Cell>& row, std::span<const Outcome> outcomes,
                   std::span<const ErrorQuantity> quantities);

}  // namespace stairway::evaluation
