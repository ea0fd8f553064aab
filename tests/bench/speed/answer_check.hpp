// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "detector/stairway.hpp"
#include "scan_assembly/point_cloud.hpp"

namespace stairway::bench {

/// What an answer is worth: how fast it came says nothing without.
struct AnswerCheck {
  int seen = 0;                        ///< flights of which the cloud holds enough points
  int found = 0;                       ///< of these
  double worst_height_error_mm = 0.0;  ///< of those found
};

/// What an answer must hold, besides nine in ten of the flights that can be seen.
struct Demands {
  int fewest_seen = 0;               ///< flights, else it is the wrong cloud
  double max_height_error_mm = 0.0;  ///< of any step height
};

/// Throws std::runtime_error when a demand is missed.
AnswerCheck check_answer(const scan::PointCloud& cloud, const detect::Detection& detection,
                         const std::vector<detect::Stairway>& truths, const Demands& demands);

}  // namespace stairway::bench
