// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "detector/localisation.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

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
  return stairway.model.step(number).from_step({.v = stairway.sides.middle()});
}

bool touches_step(const Eigen::Vector3d& nosing, const FittedStairway& stairway, int number) {
  constexpr double kBeside_m = 0.3;
  const StepPoint p = stairway.model.step(number).to_step(nosing);
  return std::abs(p.u) <= 0.75 * stairway.model.depth_m && std::abs(p.z) < 2.0 * stairway.model.height_m &&
         p.v > stairway.sides.low - kBeside_m && p.v < stairway.sides.high + kBeside_m;
}

// A spiral hides its farther steps, which may look like a flight of their own: so its turn is followed once around.
int steps_beyond(const FittedStairway& stairway) {
  if (!stairway.model.is_spiral()) return 1;
  return static_cast<int>(2.0 * std::numbers::pi / std::abs(stairway.model.turn_rad));
}

bool lies_within(const FittedStairway& small, const FittedStairway& large) {
  const int beyond = steps_beyond(large);
  int inside = 0;
  for (int number = small.first; number <= small.last; ++number) {
    const Eigen::Vector3d nosing = mid_nosing(small, number);
    bool touches = false;
    for (int other = large.first - beyond; other <= large.last + beyond && !touches; ++other)
      touches = touches_step(nosing, large, other);
    inside += touches ? 1 : 0;
  }
  return 2 * inside > small.last - small.first + 1;
}

// How high the middle of `one` lies over the step of `other` at the same place.
double height_over(const FittedStairway& one, const FittedStairway& other) {
  const Eigen::Vector3d nosing = mid_nosing(one, (one.first + one.last) / 2);
  const int beyond = steps_beyond(other);
  StepPoint nearest{.u = std::numeric_limits<double>::max()};
  for (int number = other.first - beyond; number <= other.last + beyond; ++number) {
    const StepPoint p = other.model.step(number).to_step(nosing);
    if (std::abs(p.u) < std::abs(nearest.u)) nearest = p;
  }
  return nearest.z;
}

// A flight that hangs free has steps on its underside, too, which a cloud without a sensor does not tell from treads.
bool lies_on_top_of(const FittedStairway& one, const FittedStairway& other) {
  return height_over(one, other) > 0.5 * other.model.height_m && 2 * one.evidence > other.evidence;
}

// The number of the step at `height_m`, if the way to it is short enough to be believed; else the one that was seen.
int step_at(double height_m, const StairModel& model, int seen, const LocalisationOptions& options) {
  const int number = static_cast<int>(std::lround((height_m - model.nosing.z()) / model.height_m));
  return std::abs(seen - number) > options.max_hidden_steps ? seen : number;
}

// From the first step on the ground up, or from the edge of the ground down (the paper's extension to ground level).
FittedStairway grounded(FittedStairway stairway, const LocalisationOptions& options) {
  if (stairway.on_landing) return stairway;
  const StairModel& model = stairway.model;
  if (stairway.view == View::FromBelow) {
    stairway.first =
        std::min(step_at(stairway.floor_m + model.height_m, model, stairway.first, options), stairway.last);
  } else {
    stairway.last = std::max(step_at(kGround_m, model, stairway.last, options), stairway.first);
  }
  return stairway;
}

// Under the steps of a flight or under the landing that follows on its last one.
bool is_under(const Eigen::Vector3d& nosing, const FittedStairway& flight) {
  const double width = flight.sides.length();
  const StepPoint p = flight.model.step(flight.last).to_step(nosing);
  if (p.z > 0.5 * flight.model.height_m) return false;
  if (p.u >= 0.0) return p.u < width && p.v > flight.sides.low - width && p.v < flight.sides.high + width;
  const double run = (flight.last - flight.first) * flight.model.depth_m;
  const double surface = p.u / flight.model.depth_m * flight.model.height_m;
  return p.u > -run && p.z < surface && p.v > flight.sides.low && p.v < flight.sides.high;
}

// An irregular stairway has its nosings where they were measured, a regular one where the model has them.
StepOffset offset_of(const FittedStairway& stairway, int number, bool is_irregular) {
  const auto measured = std::find_if(stairway.offsets.begin(), stairway.offsets.end(),
                                     [&](const StepOffset& offset) { return offset.number == number; });
  return is_irregular && measured != stairway.offsets.end() ? *measured : StepOffset{.number = number};
}

StepSize size_between(const Estimate& up_before, const Estimate& up, const Estimate& ahead_before,
                      const Estimate& ahead, const FittedStairway& stairway) {
  const auto sigma = [](const Estimate& a, const Estimate& b, double of_all) {
    return std::hypot(of_all, a.sigma, b.sigma);
  };
  return {.height = stairway.model.height_m + up.value - up_before.value,
          .height_sigma = sigma(up_before, up, stairway.sigmas.height_m),
          .depth = stairway.model.depth_m + ahead.value - ahead_before.value,
          .depth_sigma = sigma(ahead_before, ahead, stairway.sigmas.depth_m)};
}

void place_nosings(const FittedStairway& placed, const StairModel& model, Stairway& stairway) {
  const double half = 0.5 * placed.sides.length();
  Estimate up_before, ahead_before;  // the floor lies where the model has it
  for (int number = placed.first; number <= placed.last; ++number) {
    const StepFrame step = model.step(number);
    const StepOffset offset = offset_of(placed, number, stairway.is_irregular);
    const Estimate up = offset.up.value_or(Estimate{});
    const Estimate ahead = offset.ahead.value_or(Estimate{});
    stairway.nosings.push_back({step.from_step({.u = ahead.value, .v = half, .z = up.value}),
                                step.from_step({.u = ahead.value, .v = -half, .z = up.value})});
    stairway.step_sizes.push_back(size_between(up_before, up, ahead_before, ahead, placed));
    up_before = up;
    ahead_before = ahead;
  }
}

AnchorSide anchor_side(const Railing& railing) {
  if (railing.left == railing.right) return AnchorSide::Middle;
  return railing.left ? AnchorSide::Left : AnchorSide::Right;
}

}  // namespace

std::string LocalisationOptions::problem() const {
  return max_hidden_steps < 0 ? "max_hidden_steps must not be negative" : "";
}

FittedStairway from_parts(const Winner& winner, const std::vector<StairPart>& parts) {
  const StairGraph& graph = winner.graph;
  std::vector<double> rights;
  std::vector<double> lefts;
  for (const GraphPart& entry : graph.parts) {
    const Interval extent = sides_of(parts[entry.part], graph.model.step(entry.step));
    rights.push_back(extent.low);
    lefts.push_back(extent.high);
  }
  return {.model = graph.model,
          // Parts are cut short by what hides them and hardly ever too long.
          .sides = {outer_quartile(rights, false), outer_quartile(lefts, true)},
          .sides_sigma_m = std::hypot(standard_error(rights), standard_error(lefts)),
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
    const auto same = std::find_if(kept.begin(), kept.end(),
                                   [&](const FittedStairway& other) { return lies_within(candidate, other); });
    if (same == kept.end()) {
      kept.push_back(std::move(candidate));
    } else if (lies_on_top_of(candidate, *same)) {
      *same = std::move(candidate);
    }
  }
  return kept;
}

void begin_on_landings(std::vector<FittedStairway>& stairways) {
  const auto is_flight = [](const FittedStairway& s) { return s.view == View::FromBelow && !s.model.is_spiral(); };
  for (FittedStairway& upper : stairways) {
    if (!is_flight(upper) || upper.on_landing) continue;
    for (const FittedStairway& lower : stairways) {
      const double landing_m = lower.model.step(lower.last).nosing.z();
      const double begin_m = upper.model.step(upper.first).nosing.z();
      if (&lower == &upper || !is_flight(lower) || landing_m > begin_m - 0.5 * upper.model.height_m) continue;
      bool passes_under = false;
      for (int number = upper.first - 1; !passes_under && mid_nosing(upper, number).z() > kGround_m; --number)
        passes_under = is_under(mid_nosing(upper, number), lower);
      if (passes_under) upper.floor_m = std::max(upper.floor_m, landing_m);
    }
  }
}

Stairway localise(const FittedStairway& fitted, const LocalisationOptions& options) {
  const FittedStairway placed = grounded(fitted, options);
  const StairModel model = placed.model.moved_aside(placed.sides.middle());
  const Eigen::Vector3d descent = model.step(placed.first).descent;

  Stairway stairway;
  stairway.kind = model.is_spiral() ? StairwayKind::Spiral : StairwayKind::Straight;
  stairway.direction = placed.view == View::FromBelow ? StairwayDirection::Ascending : StairwayDirection::Descending;
  stairway.step_height = model.height_m;
  stairway.step_depth = model.depth_m;
  stairway.width = placed.sides.length();
  stairway.heading = std::atan2(-descent.y(), -descent.x());
  stairway.turn_per_step = model.turn_rad;
  stairway.step_height_sigma = placed.sigmas.height_m;
  // The depth at mid width of a spiral is known no better than its middle.
  stairway.step_depth_sigma = std::hypot(placed.sigmas.depth_m, 0.5 * placed.sides_sigma_m * model.turn_rad);
  stairway.heading_sigma = placed.sigmas.heading_rad;
  stairway.width_sigma = placed.sides_sigma_m;
  stairway.score = placed.score;

  stairway.is_irregular = are_irregular(placed.offsets);
  place_nosings(placed, model, stairway);
  stairway.railing_left = placed.railing.left;
  stairway.railing_right = placed.railing.right;
  stairway.anchor_side = anchor_side(placed.railing);
  stairway.anchor = stairway.met_nosing().at(stairway.anchor_side);
  return stairway;
}

}  // namespace stairway::detect
