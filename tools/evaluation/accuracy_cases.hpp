// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "tools/sim/scanner_model.hpp"
#include "tools/sim/scene.hpp"

namespace stairway::evaluation {

/// Mean absolute errors that are wanted; empty where none is.
struct AccuracyTargets {
  std::optional<double> height_mm, depth_mm, heading_deg, turn_deg, width_mm, along_mm, across_mm, step_height_mm;
  double found_percent = 0.0;
};

/// One line of the study: what stands before which scanner.
struct AccuracyCase {
  const char* name;
  sim::SceneSpec (*scene)(std::uint64_t seed);
  sim::ScannerOptions (*scanner)(std::uint64_t seed);
  double longest_period_s;  ///< of the disk, which that of the settings may only shorten; 0 is no limit [s]
  AccuracyTargets targets;

  bool has_stairs() const { return targets.found_percent > 0.0; }
};

/// Closed, open and open far away, tilted, descending, biased, fast, spiral, irregular; last the rooms without stairs.
/// The same seed gives the same scene and the same scanner on every machine.
std::span<const AccuracyCase> accuracy_cases();

}  // namespace stairway::evaluation
