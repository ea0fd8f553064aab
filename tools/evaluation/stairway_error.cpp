// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "tools/evaluation/stairway_error.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tools/common/stairway_match.hpp"

namespace stairway::evaluation {
namespace {

double turn_between(double from_rad, double to_rad) {
  return std::remainder(to_rad - from_rad, 2.0 * std::numbers::pi);
}

}  // namespace

StairwayError error_of(const detect::Stairway& found, const detect::Stairway& truth) {
  const detect::Nosing& nosing = truth.met_nosing();
  const Eigen::Vector2d left = (nosing.left - nosing.right).head<2>().normalized();
  const Eigen::Vector2d ascent(left.y(), -left.x());
  const Eigen::Vector3d off = found.anchor - nosing.at(found.anchor_side);
  return {.height_m = found.step_height - truth.step_height,
          .depth_m = found.step_depth - truth.step_depth,
          .width_m = found.width - truth.width,
          .pitch_rad = found.pitch() - truth.pitch(),
          .heading_rad = turn_between(truth.heading, found.heading),
          .turn_rad = found.turn_per_step - truth.turn_per_step,
          .along_m = off.head<2>().dot(ascent),
          .across_m = off.head<2>().dot(left),
          .up_m = off.z(),
          .middle_m = (found.met_nosing().middle() - nosing.middle()).head<2>().norm(),
          .steps = static_cast<int>(found.nosings.size()) - static_cast<int>(truth.nosings.size()),
          .is_right_kind = found.kind == truth.kind,
          .is_right_direction = found.direction == truth.direction,
          .anchor_side = found.anchor_side};
}

Outcome outcome_of(const detect::Detection& detection, const std::vector<detect::Stairway>& truths,
                   std::size_t wanted) {
  const auto pairs = tools::match(truths, detection.stairways);
  Outcome outcome{.error = {}, .false_count = static_cast<int>(detection.stairways.size() - pairs.size())};
  for (const auto& [truth, found] : pairs)
    if (truth == wanted) outcome.error = error_of(detection.stairways[found], truths[truth]);
  return outcome;
}

int found_count(std::span<const Outcome> outcomes) {
  return found_count(outcomes, [](const StairwayError&) { return true; });
}

int found_count(std::span<const Outcome> outcomes, const std::function<bool(const StairwayError&)>& is_right) {
  return static_cast<int>(
      std::count_if(outcomes.begin(), outcomes.end(), [&](const Outcome& o) { return o.error && is_right(*o.error); }));
}

int false_count(std::span<const Outcome> outcomes) {
  int count = 0;
  for (const Outcome& outcome : outcomes) count += outcome.false_count;
  return count;
}

int right_step_count(std::span<const Outcome> outcomes) {
  return found_count(outcomes, [](const StairwayError& e) { return e.steps == 0; });
}

}  // namespace stairway::evaluation
