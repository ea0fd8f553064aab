// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "detector/stairway.hpp"

namespace stairway::daemon {

/// Gives the same number to the same stairway in every pass while the robot stands.
///
/// It is the same one if its kind and direction are the same and the places where one enters it lie within 0.3 m, the
/// nearest pair first. A number is forgotten after 3 final answers without its stairway, and never used again.
///
/// A preview may show a part of a stairway: there it is enough that the middle of one entry lies within 0.3 m of the
/// other entry's edge. What a preview does not show has not been missed.
class StairwayTracker {
 public:
  /// The numbers of the stairways of a final answer, in their order, from 1.
  std::vector<std::int64_t> follow(std::span<const detect::Stairway> stairways);

  /// Those of a preview's.
  std::vector<std::int64_t> follow_preview(std::span<const detect::Stairway> stairways);

 private:
  struct Track {
    std::int64_t id;
    std::optional<detect::Stairway> last;     // in a final answer
    std::optional<detect::Stairway> preview;  // since then
    int missed_passes = 0;
    bool is_seen = false;  // in this pass
  };
  std::vector<std::int64_t> number(std::span<const detect::Stairway> stairways, bool is_preview);

  std::vector<Track> tracks_;
  std::int64_t next_id_ = 1;
};

}  // namespace stairway::daemon
