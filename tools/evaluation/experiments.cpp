// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "tools/evaluation/accuracy.hpp"
#include "tools/evaluation/depth_camera.hpp"
#include "tools/evaluation/experiment.hpp"
#include "tools/evaluation/large_scale.hpp"
#include "tools/evaluation/occlusion.hpp"
#include "tools/evaluation/random_flights.hpp"
#include "tools/evaluation/segmentation.hpp"
#include "tools/evaluation/series.hpp"
#include "tools/evaluation/strategies.hpp"

namespace stairway::evaluation {

int shared_count(int count, double share) { return std::clamp(static_cast<int>(std::lround(share * count)), 1, count); }

std::span<const Experiment> experiments() {
  static constexpr Experiment kExperiments[]{
      {"occlusion", "the anchor when a wall hides the right side of the stairway (Fig 11)", run_occlusion},
      {"segmentation", "planes and points found by the three segmentations, and their time (Figs 15, 16)",
       run_segmentation},
      {"descending", "flights that go down, seen from their upper edge (Fig 17 c)", run_descending},
      {"spiral", "spirals, closed and open, turning left and right (Fig 17 d)", run_spiral},
      {"series", "errors over the distance at stairways I and III (Figs 18 and 23, Table 2)", run_series},
      {"strategies", "greedy, thorough, optimizing and joint: errors and time (Figs 19 and 20)", run_strategies},
      {"large-scale", "buildings merged from many sweeps: time and memory over the points (Fig 21)", run_large_scale},
      {"depth-camera", "stairs from single frames of a depth camera on a helmet (Table 3, Fig 22)", run_depth_camera},
      {"accuracy", "errors in random rooms beside what the sensor allows, and how honest the sigmas are", run_accuracy},
  };
  return kExperiments;
}

}  // namespace stairway::evaluation
