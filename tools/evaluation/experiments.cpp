// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "tools/evaluation/experiment.hpp"
#include "tools/evaluation/segmentation.hpp"

namespace stairway::evaluation {

std::span<const Experiment> experiments() {
  static constexpr Experiment kExperiments[]{
      {"segmentation", "planes and points found by the three segmentations, and their time (Figs 15, 16)",
       run_segmentation},
  };
  return kExperiments;
}

}  // namespace stairway::evaluation
