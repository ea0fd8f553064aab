// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "detector/stair_model.hpp"

#include <cmath>

namespace stairway::detect {

StepPoint StepFrame::to_step(const Eigen::Vector3d& p) const {
  const Eigen::Vector3d off = p - nosing;
  return {.u = -off.dot(descent), .v = off.dot(left()), .z = off.z()};
}

Eigen::Vector3d StepFrame::from_step(const StepPoint& p) const {
  return nosing - p.u * descent + p.v * left() + p.z * Eigen::Vector3d::UnitZ();
}

StepFrame StairModel::step(double number) const {
  const Eigen::Vector3d rise = number * height_m * Eigen::Vector3d::UnitZ();
  if (!is_spiral()) return {.nosing = nosing - number * depth_m * descent + rise, .descent = descent};
  const Eigen::AngleAxisd turn(number * turn_rad, Eigen::Vector3d::UnitZ());
  const Eigen::Vector3d to_axis = radius_m() * descent.cross(Eigen::Vector3d::UnitZ());
  return {.nosing = nosing + to_axis - turn * to_axis + rise, .descent = turn * descent};
}

double StairModel::radius_m() const { return 0.5 * depth_m / std::sin(0.5 * turn_rad); }

StairModel StairModel::moved_aside(double left_m) const {
  StairModel moved = *this;
  moved.nosing += left_m * step(0).left();
  if (is_spiral()) moved.depth_m = 2.0 * (radius_m() - left_m) * std::sin(0.5 * turn_rad);
  return moved;
}

std::string StepLimits::problem() const {
  if (!(0.0 < min_height_m && min_height_m < max_height_m)) return "step heights must satisfy 0 < minimum < maximum";
  if (!(0.0 < min_depth_m && min_depth_m < max_depth_m)) return "step depths must satisfy 0 < minimum < maximum";
  if (!(0.0 < min_slope_rad && min_slope_rad < max_slope_rad)) return "slopes must satisfy 0 < minimum < maximum";
  if (!(0.0 < min_turn_rad && min_turn_rad < max_turn_rad && max_turn_rad < std::numbers::pi / 2))
    return "turns must satisfy 0 < minimum < maximum < 90 degrees";
  return {};
}

bool StepLimits::allow(const StairModel& model) const {
  const auto within = [](double value, double low, double high) { return value >= low && value <= high; };
  return within(model.height_m, min_height_m, max_height_m) && within(model.depth_m, min_depth_m, max_depth_m) &&
         within(std::atan2(model.height_m, model.depth_m), min_slope_rad, max_slope_rad) &&
         (!model.is_spiral() || within(std::abs(model.turn_rad), min_turn_rad, max_turn_rad));
}

}  // namespace stairway::detect
