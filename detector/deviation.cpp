// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "detector/deviation.hpp"

#include <algorithm>
#include <cmath>

namespace stairway::detect {
namespace {

double excess(double value, double limit) { return std::max(value - limit, 0.0); }

Deviation riser_deviation(const StairModel& model, const StepFrame& step, const StairPart& riser, View view) {
  Deviation result;
  result.depth_m = std::abs((step.nosing - riser.centroid).dot(step.descent));  // eq 5
  const double top_est = step.nosing.z();                                       // eq 9, with z of P
  const double bottom_est = top_est - model.height_m;                           // eq 10
  if (view == View::FromBelow) {
    result.height_m = std::abs(riser.top.z() - top_est);  // eq 11
  } else {
    result.height_m = excess(riser.top.z(), top_est) + excess(bottom_est, riser.bottom.z());  // eq 8
  }
  const double cosine = std::min(std::abs(step.descent.dot(riser.facing)), 1.0);
  result.direction_rad = std::acos(cosine);  // eq 13; the printed one has the absolute value outside the arc cosine
  return result;
}

// Depths of a tread are taken along the direction in its middle, which on a spiral lies between those of two nosings.
Deviation tread_deviation(const StairModel& model, int number, const StairPart& tread, View view) {
  Deviation result;
  const StepFrame step = model.step(number);
  const StepFrame middle = model.step(number + 0.5);
  const Interval extent = part_extent(tread, middle.descent);
  const double front_est = middle.nosing.dot(middle.descent) + 0.5 * model.depth_m;
  const double back_est = front_est - model.depth_m;
  if (view == View::FromBelow) {
    // Eq 16 read like eq 8: as printed, its two excesses would have opposite signs along one axis.
    result.depth_m = excess(extent.high, front_est) + excess(back_est, extent.low);
  } else {
    result.depth_m = std::abs(extent.high - front_est);  // eq 17
  }
  const double surface = step.nosing.z() - (tread.from_below ? model.tread_thickness_m : 0.0);
  result.height_m = std::abs(surface - tread.centroid.z());  // eq 19, with a unit vector and its absolute value
  return result;
}

// Ours. Seen from below or above, a bar is spread about the nosing it stands for.
Deviation edge_deviation(const StepFrame& step, const StairPart& edge) {
  return {.depth_m = std::abs((step.nosing - edge.centroid).dot(step.descent)),
          .height_m = std::abs(step.nosing.z() - edge.centroid.z()),
          .direction_rad = std::acos(std::min(std::abs(step.descent.dot(edge.facing)), 1.0))};
}

}  // namespace

Interval part_extent(const StairPart& part, const Eigen::Vector3d& axis) {
  Interval extent;
  const double along_axis = std::abs(part.facing.dot(axis));
  const bool depthwise = along_axis > std::sqrt(0.5);
  const double one = (depthwise ? part.front : part.end_a).dot(axis);
  const double other = (depthwise ? part.back : part.end_b).dot(axis);
  extent.low = std::min(one, other);
  extent.high = std::max(one, other);
  return extent;
}

Interval sides_of(const StairPart& part, const StepFrame& step) {
  const Interval extent = part_extent(part, step.left());
  const double middle = step.nosing.dot(step.left());
  return {extent.low - middle, extent.high - middle};
}

Deviation deviation(const StairModel& model, int number, const StairPart& part, View view) {
  const StepFrame step = model.step(number);
  switch (part.kind) {
    case StairPart::Kind::Riser:
      return riser_deviation(model, step, part, view);
    case StairPart::Kind::Tread:
      return tread_deviation(model, number, part, view);
    case StairPart::Kind::Edge:
      break;
  }
  return edge_deviation(step, part);
}

}  // namespace stairway::detect
