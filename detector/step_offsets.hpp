// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "detector/step_measurement.hpp"

namespace stairway::detect {

/// How far the nosing of one step lies from where the regular model has it.
struct StepOffset {
  int number = 0;
  std::optional<Estimate> up;     ///< above [m]
  std::optional<Estimate> ahead;  ///< farther along the ascent [m]
};

/// What lines of sight and bars are off by at all steps alike, in rad of the sensor's view; known from the joint fit.
struct CommonBiases {
  double sight_rad = 0.0;
  double bar_rad = 0.0;
};

/// The offset of every measured step from `model`. A height is that of the tread where it was seen, else of the line of
/// sight over the nosing.
std::vector<StepOffset> step_offsets(const StairModel& model, const CommonBiases& biases,
                                     const std::vector<StepMeasurement>& steps);

/// Whether the steps differ by more than their measurements' errors explain, and by more than nobody would mind.
/// @param but_for_one  one of them alone, the worst, is not believed.
bool are_irregular(const std::vector<StepOffset>& offsets, bool but_for_one = false);

}  // namespace stairway::detect
