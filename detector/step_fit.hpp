// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "detector/stair_fit.hpp"
#include "detector/step_measurement.hpp"
#include "detector/step_offsets.hpp"

namespace stairway::detect {

/// A model fitted to measured steps.
struct StepFit {
  StairModel model;
  FitSigmas sigmas;
  CommonBiases biases;  ///< of lines of sight and bars, alike at all steps
};

/// One robust weighted least squares over what was measured on all steps: fronts fix d, s and delta phi, treads and the
/// edges of sight fix h; overhang and thickness of the treads are found on the way. A straight flight stays straight.
/// @param start       where the steps were measured.
/// @param prior       of the graph; keeps what the steps leave open.
/// @param has_risers  most fronts are risers, before which nosings usually stand out.
/// Cost: a few rounds of residuals of every step.
StepFit fit_to_steps(const StairModel& start, const StairModel& prior, bool has_risers,
                     const std::vector<StepMeasurement>& steps);

}  // namespace stairway::detect
