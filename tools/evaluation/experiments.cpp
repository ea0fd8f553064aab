// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "tools/evaluation/depth_camera.hpp"
#include "tools/evaluation/experiment.hpp"
#include "tools/evaluation/occlusion.hpp"
#include "tools/evaluation/segmentation.hpp"
#include "tools/evaluation/series.hpp"
#include "tools/evaluation/strategies.hpp"

namespace stairway::evaluation {

std::span<const Experiment> experiments() {
  static constexpr Experiment kExperiments[]{
      {"occlusion", "the anchor when a wall hides the right side of the stairway (Fig 11)", run_occlusion},
      {"segmentation", "planes and points found by the three segmentations, and their time (Figs 15, 16)",
       run_segmentation},
      {"series", "errors over the distance at stairways I and III (Figs 18 and 23, Table 2)", run_series},
      {"strategies", "greedy, thorough, optimizing and joint: errors and time (Figs 19 and 20)", run_strategies},
      {"depth-camera", "stairs from single frames of a depth camera on a helmet (Table 3, Fig 22)", run_depth_camera},
  };
  return kExperiments;
}

}  // namespace stairway::evaluation
