// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "detector/localisation.hpp"

#include <algorithm>
#include <cmath>

#include "detector/statistics.hpp"

namespace stairway::detect {
namespace {

constexpr double kGround_m = 0.0;

double standard_error(const std::vector<double>& values) {
  if (values.size() < 2) return 0.0;
  const Eigen::Map<const Eigen::ArrayXd> array(values.data(), static_cast<Eigen::Index>(values.size()));
  const double n = static_cast<double>(values.size());
  return std::sqrt((array - array.mean()).square().sum() / (n - 1.0) / n);
}

Eigen::Vector3d mid_nosing(const FittedStairway& stairway, int number) {
  const StepFrame step = stairway.model.step(number);
  return step.nosing + step.left() * (stairway.side.middle() - step.nosing.dot(step.left()));
}

bool lies_within(const FittedStairway& small, const FittedStairway& large) {
  const StairModel& model = large.model;
  int inside = 0;
  for (int number = small.first; number <= small.last; ++number) {
    const Eigen::Vector3d nosing = mid_nosing(small, number);
    const Eigen::Vector3d off = nosing - model.nosing;
    const double steps_up = -off.dot(model.descent) / model.depth_m;
    const double above_line = off.z() - steps_up * model.height_m;
    const double side = nosing.dot(model.step(0).left());
    if (steps_up > large.first - 1.5 && steps_up < large.last + 1.5 && std::abs(above_line) < 1.5 * model.height_m &&
        side > large.side.low - 0.3 && side < large.side.high + 0.3)
      ++inside;
  }
  return 2 * inside > small.last - small.first + 1;
}

// The number of the step whose riser stands on the ground, if the way down to it is short enough to be believed.
int first_step_number(const StairModel& model, int first_seen, const LocalisationOptions& options) {
  const int on_ground = static_cast<int>(std::lround((kGround_m - model.nosing.z()) / model.height_m)) + 1;
  return first_seen - on_ground > options.max_hidden_steps ? first_seen : on_ground;
}

}  // namespace

std::string LocalisationOptions::problem() const {
  return max_hidden_steps < 0 ? "max_hidden_steps must not be negative" : "";
}

FittedStairway from_parts(const Winner& winner, const std::vector<StairPart>& parts) {
  const StairGraph& graph = winner.graph;
  const Eigen::Vector3d left = graph.model.step(0).left();
  std::vector<double> rights;
  std::vector<double> lefts;
  for (const GraphPart& entry : graph.parts) {
    const Interval extent = part_extent(parts[entry.part], left);
    rights.push_back(extent.low);
    lefts.push_back(extent.high);
  }
  return {.model = graph.model,
          // Parts are cut short by what hides them and hardly ever too long.
          .side = {outer_quartile(rights, false), outer_quartile(lefts, true)},
          .side_sigma_m = std::hypot(standard_error(rights), standard_error(lefts)),
          .sigmas = winner.sigmas,
          .first = graph.parts.front().step,
          .last = graph.parts.back().step,
          .view = winner.view,
          .score = winner.score,
          .evidence = static_cast<int>(graph.parts.size())};
}

std::vector<FittedStairway> without_duplicates(std::vector<FittedStairway> stairways) {
  std::stable_sort(stairways.begin(), stairways.end(),
                   [](const FittedStairway& a, const FittedStairway& b) { return a.evidence > b.evidence; });
  std::vector<FittedStairway> kept;
  for (FittedStairway& candidate : stairways) {
    const bool known = std::any_of(kept.begin(), kept.end(),
                                   [&](const FittedStairway& other) { return lies_within(candidate, other); });
    if (!known) kept.push_back(std::move(candidate));
  }
  return kept;
}

Stairway localise(const FittedStairway& fitted, const LocalisationOptions& options) {
  const StairModel& model = fitted.model;
  const Eigen::Vector3d left = model.step(0).left();

  Stairway stairway;
  stairway.kind = StairwayKind::Straight;
  stairway.direction = fitted.view == View::FromBelow ? StairwayDirection::Ascending : StairwayDirection::Descending;
  stairway.step_height = model.height_m;
  stairway.step_depth = model.depth_m;
  stairway.width = fitted.side.length();
  stairway.heading = std::atan2(-model.descent.y(), -model.descent.x());
  stairway.step_height_sigma = fitted.sigmas.height_m;
  stairway.step_depth_sigma = fitted.sigmas.depth_m;
  stairway.heading_sigma = fitted.sigmas.heading_rad;
  stairway.width_sigma = fitted.side_sigma_m;
  stairway.score = fitted.score;

  const int first = std::min(first_step_number(model, fitted.first, options), fitted.last);
  for (int number = first; number <= fitted.last; ++number) {
    const Eigen::Vector3d nosing = model.step(number).nosing;
    const Eigen::Vector3d on_axis = nosing - left * nosing.dot(left);
    stairway.nosings.push_back({on_axis + left * fitted.side.high, on_axis + left * fitted.side.low});
  }
  const Nosing& meeting =
      stairway.direction == StairwayDirection::Ascending ? stairway.nosings.front() : stairway.nosings.back();
  stairway.anchor_side = AnchorSide::Middle;
  stairway.anchor = 0.5 * (meeting.left + meeting.right);
  return stairway;
}

}  // namespace stairway::detect
