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

Eigen::Vector3d Nosing::at(AnchorSide side) const {
  if (side == AnchorSide::Middle) return middle();
  return side == AnchorSide::Left ? left : right;
}

const Nosing& Stairway::met_nosing() const {
  return direction == StairwayDirection::Ascending ? nosings.front() : nosings.back();
}

double Stairway::pitch() const { return std::atan2(step_height, step_depth); }

}  // namespace stairway::detect
