// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

#include "detector/stair_model.hpp"

namespace stairway::detect {

/// A point in the coordinates of a flight, which unroll a spiral and lay the line of nosings level: there a handrail is
/// a horizontal straight line and a baluster a vertical one, on every stairway.
struct FlightPoint {
  double step = 0.0;     ///< how far up, as a real step number: 1.5 is above the middle of tread 1
  double side_m = 0.0;   ///< to the left, from the model's middle line
  double above_m = 0.0;  ///< above the line through the nosings, vertically

  /// With the run of the middle line in place of the step number [m].
  Eigen::Vector3d straightened(const StairModel& model) const { return {step * model.depth_m, side_m, above_m}; }
};

/// Of the turns of a spiral that pass under a point, the one is meant that runs between 0.6 m above and about a storey
/// below it.
FlightPoint to_flight(const StairModel& model, const Eigen::Vector3d& p);

}  // namespace stairway::detect
