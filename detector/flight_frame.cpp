// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "detector/flight_frame.hpp"

#include <cmath>
#include <numbers>

namespace stairway::detect {
namespace {

constexpr double kBelow_m = 0.6;

FlightPoint to_spiral(const StairModel& model, const StepPoint& from_first) {
  const double radius = model.radius_m();
  // Seen from the axis: where step 0 has its nosing the angle is 0, and it grows up the stairway.
  const double outwards = (radius - from_first.v) * std::copysign(1.0, radius);
  const double angle = std::atan2(from_first.u, outwards);
  const double step = angle / std::abs(model.turn_rad);
  const double steps_per_turn = 2.0 * std::numbers::pi / std::abs(model.turn_rad);
  const double above = from_first.z - step * model.height_m;
  const double turns = std::floor((above + kBelow_m) / (steps_per_turn * model.height_m));
  const double distance = std::hypot(from_first.u, outwards);
  return {.step = step + turns * steps_per_turn,
          .side_m = (std::abs(radius) - distance) * std::copysign(1.0, radius),
          .above_m = above - turns * steps_per_turn * model.height_m};
}

}  // namespace

FlightPoint to_flight(const StairModel& model, const Eigen::Vector3d& p) {
  const StepPoint from_first = model.step(0).to_step(p);
  if (model.is_spiral()) return to_spiral(model, from_first);
  const double step = from_first.u / model.depth_m;
  return {.step = step, .side_m = from_first.v, .above_m = from_first.z - step * model.height_m};
}

}  // namespace stairway::detect
