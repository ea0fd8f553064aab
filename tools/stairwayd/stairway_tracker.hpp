// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "detector/stairway.hpp"

namespace stairway::daemon {

/// Gives the same number to the same stairway in every pass while the robot stands.
///
/// It is the same one if its kind and direction are the same and the places where one enters it lie within 0.3 m, the
/// nearest pair first. A number is forgotten after 3 passes without its stairway, and never used again.
class StairwayTracker {
 public:
  /// The numbers of the stairways of the next pass, in their order, from 1.
  std::vector<std::int64_t> follow(std::span<const detect::Stairway> stairways);

 private:
  struct Track {
    std::int64_t id;
    detect::Stairway last;
    int missed_passes = 0;
  };
  std::vector<Track> tracks_;
  std::int64_t next_id_ = 1;
};

}  // namespace stairway::daemon
