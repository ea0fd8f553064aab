// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "detector/stairway.hpp"

#include <cmath>

namespace stairway::detect {

std::string_view to_string(StairwayKind kind) { return kind == StairwayKind::Straight ? "straight" : "spiral"; }

std::string_view to_string(StairwayDirection direction) {
  return direction == StairwayDirection::Ascending ? "ascending" : "descending";
}

std::string_view to_string(AnchorSide side) {
  switch (side) {
    case AnchorSide::Left:
      return "left";
    case AnchorSide::Middle:
      return "middle";
    case AnchorSide::Right:
      break;
  }
  return "right";
}

double Stairway::pitch() const { return std::atan2(step_height, step_depth); }

}  // namespace stairway::detect
