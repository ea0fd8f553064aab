// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "detector/step_offsets.hpp"

#include <algorithm>
#include <cmath>

namespace stairway::detect {
namespace {

// What one measured step may be off by for reasons its scatter does not show.
constexpr double kHeightFloor_m = 0.001;
constexpr double kPlaceFloor_m = 0.0005;
constexpr double kSteepestSight = 0.7;  // steeper ones tell places, not heights

std::optional<Estimate> height_offset(const StepFrame& predicted, const CommonBiases& biases,
                                      const StepMeasurement& step) {
  const double rise = predicted.nosing.z() - step.frame.nosing.z();
  if (step.surface) return Estimate{step.surface->value - rise, std::hypot(step.surface->sigma, kHeightFloor_m)};
  if (!step.nosing || step.nosing->without_sight || std::abs(step.nosing->along_u) < kSteepestSight)
    return std::nullopt;
  const StepPoint p = predicted.to_step(step.frame.from_step(step.nosing->at));
  const double slope = step.nosing->along_z / step.nosing->along_u;
  const double outwards =
      step.nosing->over_a_front ? biases.sight_rad * step.nosing->distance_m / step.nosing->along_u : 0.0;
  return Estimate{p.z - p.u * slope - outwards,
                  std::hypot(step.nosing->sigma_m, kHeightFloor_m) / std::abs(step.nosing->along_u)};
}

std::optional<Estimate> place_offset(const StairModel& model, const StepFrame& predicted, const CommonBiases& biases,
                                     const StepMeasurement& step) {
  if (!step.front) return std::nullopt;
  const double u = predicted.to_step(step.frame.from_step({step.front->value, step.middle_v, 0.0})).u;
  const double expected = step.is_bar ? biases.bar_rad * step.distance_m : model.overhang_m;
  return Estimate{u - expected, std::hypot(step.front->sigma, kPlaceFloor_m)};
}

}  // namespace

std::vector<StepOffset> step_offsets(const StairModel& model, const CommonBiases& biases,
                                     const std::vector<StepMeasurement>& steps) {
  std::vector<StepOffset> offsets;
  for (const StepMeasurement& step : steps) {
    const StepFrame predicted = model.step(step.number);
    offsets.push_back({.number = step.number,
                       .up = height_offset(predicted, biases, step),
                       .ahead = place_offset(model, predicted, biases, step)});
  }
  return offsets;
}

bool are_irregular(const std::vector<StepOffset>& offsets, bool but_for_one) {
  constexpr double kNobodyMinds_m = 0.004;  // root mean square
  constexpr double kChi2PerStep = 6.0;
  constexpr double kAnotherThing_m = 0.045;  // not the step, or not this one
  constexpr std::size_t kFewest = 3;
  for (const auto part : {&StepOffset::up, &StepOffset::ahead}) {
    std::vector<Estimate> believed;
    for (const StepOffset& offset : offsets)
      if (const std::optional<Estimate>& off = offset.*part; off && std::abs(off->value) < kAnotherThing_m)
        believed.push_back(*off);
    if (but_for_one && !believed.empty())
      believed.erase(std::max_element(believed.begin(), believed.end(), [](const Estimate& a, const Estimate& b) {
        return std::abs(a.value) < std::abs(b.value);
      }));
    if (believed.size() < kFewest) continue;
    const double n = static_cast<double>(believed.size());
    double sum = 0.0;
    double chi2 = 0.0;
    for (const Estimate& off : believed) {
      sum += off.value * off.value;
      chi2 += off.value * off.value / (off.sigma * off.sigma);
    }
    if (sum > n * kNobodyMinds_m * kNobodyMinds_m && chi2 > kChi2PerStep * n) return true;
  }
  return false;
}

}  // namespace stairway::detect
