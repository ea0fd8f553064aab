// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "detector/stairway.hpp"

namespace stairway::evaluation {

/// How far a stairway that was found is off: found minus true.
struct StairwayError {
  double height_m = 0.0;
  double depth_m = 0.0;
  double width_m = 0.0;
  double pitch_rad = 0.0;
  double heading_rad = 0.0;
  double turn_rad = 0.0;  ///< of a spiral, per step
  double along_m = 0.0;   ///< of the anchor, in the direction of ascent: the paper's delta x, but for the sign
  double across_m = 0.0;  ///< of the anchor, to the left seen while ascending: its delta y
  double up_m = 0.0;      ///< of the anchor
  double middle_m = 0.0;  ///< horizontal distance of the middle of the anchor's nosing from the true one, >= 0
  int steps = 0;
  bool is_right_kind = true;                                    ///< straight or spiral
  bool is_right_direction = true;                               ///< ascending or descending
  detect::AnchorSide anchor_side = detect::AnchorSide::Middle;  ///< that was found

  /// Horizontal distance of the anchor from the true end, or middle, of its nosing.
  double anchor_m() const { return Eigen::Vector2d(along_m, across_m).norm(); }
};

/// The anchor is compared with the end of the true nosing that its side names.
/// @pre both have nosings.
StairwayError error_of(const detect::Stairway& found, const detect::Stairway& truth);

/// What was found in one cloud.
struct Outcome {
  std::optional<StairwayError> error;  ///< of the stairway that was looked for; empty when it was not found
  int false_count = 0;                 ///< stairways that the truth does not know
};

/// Compares an answer with the stairway truths[wanted] and counts what belongs to none.
Outcome outcome_of(const detect::Detection& detection, const std::vector<detect::Stairway>& truths,
                   std::size_t wanted = 0);

/// Sums over some outcomes.
int found_count(std::span<const Outcome> outcomes);
int found_count(std::span<const Outcome> outcomes, const std::function<bool(const StairwayError&)>& is_right);
int false_count(std::span<const Outcome> outcomes);
int right_step_count(std::span<const Outcome> outcomes);  ///< found with the right number of steps

}  // namespace stairway::evaluation
