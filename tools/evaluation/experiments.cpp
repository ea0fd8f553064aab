// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "tools/evaluation/depth_camera.hpp"
#include "tools/evaluation/experiment.hpp"
#include "tools/evaluation/segmentation.hpp"

namespace stairway::evaluation {

std::span<const Experiment> experiments() {
  static constexpr Experiment kExperiments[]{
      {"segmentation", "planes and points found by the three segmentations, and their time (Figs 15, 16)",
       run_segmentation},
      {"depth-camera", "stairs from single frames of a depth camera on a helmet (Table 3, Fig 22)", run_depth_camera},
  };
  return kExperiments;
}

}  // namespace stairway::evaluation
