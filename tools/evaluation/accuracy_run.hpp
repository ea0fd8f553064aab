// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "tools/evaluation/accuracy_bound.hpp"
#include "tools/evaluation/accuracy_cases.hpp"
#include "tools/evaluation/experiment.hpp"
#include "tools/evaluation/stairway_error.hpp"

namespace stairway::evaluation {

/// What one scene has shown.
struct AccuracyRun {
  Outcome outcome;
  std::optional<detect::Stairway> found;     ///< that the outcome's error is of
  std::vector<double> step_height_errors_m;  ///< of every step between two nosings that were found: found minus true
  std::optional<AccuracyBound> bound;
};

/// Simulates and detects in scene `request.seed + index` of a case.
AccuracyRun run_accuracy_case(const AccuracyCase& of, const Request& request, std::size_t index);

/// The stairways of a scene as a robot tilted like the scanner's should tell them: in the frame that its own becomes
/// when it is levelled by the least turn.
std::vector<detect::Stairway> levelled_truths(const sim::Scene& scene, const sim::ScannerOptions& scanner);

/// Rises between neighbouring nosings, those of `found` less the true ones of the same place.
std::vector<double> step_height_errors(const detect::Stairway& found, const detect::Stairway& truth);

}  // namespace stairway::evaluation
