// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "detector/spiral_initialisation.hpp"

#include <cmath>

#include "detector/deviation.hpp"

namespace stairway::detect {
namespace {

/// How two parts face, both towards the descent.
struct Facing {
  Eigen::Vector3d lower;
  Eigen::Vector3d upper;
  Eigen::Vector3d bisector;
  double turn_rad;  ///< delta phi
};

Facing facing_of(const StairPart& lower, const StairPart& upper) {
  const Eigen::Vector3d down = lower.centroid - upper.centroid;
  const auto towards_descent = [&](const Eigen::Vector3d& direction) {
    return direction.dot(down) < 0.0 ? Eigen::Vector3d(-direction) : direction;
  };
  Facing facing{.lower = towards_descent(lower.facing), .upper = towards_descent(upper.facing)};
  facing.bisector = (facing.lower + facing.upper).normalized();
  facing.turn_rad = std::atan2(facing.lower.cross(facing.upper).z(), facing.lower.dot(facing.upper));
  return facing;
}

Eigen::Vector3d middle_of(const StairPart& part) { return 0.5 * (part.end_a + part.end_b); }

// Risers and edges stand where the nosings of their steps are.
StairModel spiral_at(const StairPart& lower, const StairPart& upper, const Facing& facing, double height, double top) {
  StairModel model;
  model.height_m = height;
  model.depth_m = (middle_of(lower) - middle_of(upper)).dot(facing.bisector);
  model.turn_rad = facing.turn_rad;
  model.descent = facing.lower;
  model.nosing = middle_of(lower);
  model.nosing.z() = top;
  return model;
}

// A tread reaches from its nosing to half a turn on; its direction is that of its middle.
StairModel spiral_through_middles(const StairPart& lower, const StairPart& upper, const Facing& facing, double depth) {
  StairModel half_way;
  half_way.height_m = upper.centroid.z() - lower.centroid.z();
  half_way.depth_m = depth;
  half_way.turn_rad = facing.turn_rad;
  half_way.descent = facing.lower;
  half_way.nosing = middle_of(lower);
  half_way.nosing.z() = lower.centroid.z();
  if (lower.from_below) {
    half_way.tread_thickness_m = kTypicalTreadThickness_m;
    half_way.nosing.z() += kTypicalTreadThickness_m;
  }
  StairModel model = half_way;
  const StepFrame nosing = half_way.step(-0.5);
  model.nosing = {nosing.nosing.x(), nosing.nosing.y(), half_way.nosing.z()};
  model.descent = nosing.descent;
  return model;
}

}  // namespace

std::vector<StairModel> suggested_spirals(const StairPart& lower, const StairPart& upper) {
  const Facing facing = facing_of(lower, upper);
  if (facing.turn_rad == 0.0) return {};
  switch (lower.kind) {
    case StairPart::Kind::Riser: {
      const double h_tt = upper.top.z() - lower.top.z();
      const double h_bb = upper.bottom.z() - lower.bottom.z();
      return {spiral_at(lower, upper, facing, h_tt, lower.top.z()),
              spiral_at(lower, upper, facing, h_bb, lower.bottom.z() + h_bb)};
    }
    case StairPart::Kind::Tread: {
      if (lower.from_below != upper.from_below) return {};
      const Interval below = part_extent(lower, facing.bisector);
      const Interval above = part_extent(upper, facing.bisector);
      return {spiral_through_middles(lower, upper, facing, below.high - above.high),
              spiral_through_middles(lower, upper, facing, below.low - above.low)};
    }
    case StairPart::Kind::Edge:
      break;
  }
  return {spiral_at(lower, upper, facing, upper.centroid.z() - lower.centroid.z(), lower.centroid.z())};
}

}  // namespace stairway::detect
