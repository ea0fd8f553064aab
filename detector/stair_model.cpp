// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "detector/stair_model.hpp"

#include <cmath>

namespace stairway::detect {

StepFrame StairModel::step(int number) const {
  const double j = number;
  return {.nosing = nosing - j * depth_m * descent + j * height_m * Eigen::Vector3d::UnitZ(), .descent = descent};
}

std::string StepLimits::problem() const {
  if (!(0.0 < min_height_m && min_height_m < max_height_m)) return "step heights must satisfy 0 < minimum < maximum";
  if (!(0.0 < min_depth_m && min_depth_m < max_depth_m)) return "step depths must satisfy 0 < minimum < maximum";
  if (!(0.0 < min_slope_rad && min_slope_rad < max_slope_rad)) return "slopes must satisfy 0 < minimum < maximum";
  return {};
}

bool StepLimits::allow(double height_m, double depth_m) const {
  const double slope = std::atan2(height_m, depth_m);
  return height_m >= min_height_m && height_m <= max_height_m && depth_m >= min_depth_m && depth_m <= max_depth_m &&
         slope >= min_slope_rad && slope <= max_slope_rad;
}

}  // namespace stairway::detect
