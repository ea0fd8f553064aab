// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

namespace stairway::detect {

/// A place of an edge or front of a step, seen from above [m].
struct PlacePoint {
  double u = 0.0;
  double v = 0.0;
};

/// The straight line u = value + turn v, and how its points lie along v.
struct StepLine {
  double value = 0.0;       ///< [m]
  double turn = 0.0;        ///< slope du/dv
  double variance_v = 0.0;  ///< [m^2]
};

/// Least squares. A line through fewer than two points, or through points of one v, keeps its slope.
void fit_line(const std::vector<PlacePoint>& points, StepLine& line);

}  // namespace stairway::detect
