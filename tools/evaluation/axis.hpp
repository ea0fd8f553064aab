// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace stairway::evaluation {

/// One direction of a chart: a range between round numbers, and the numbers that are written beside it.
struct Axis {
  double low = 0.0;
  double high = 1.0;
  bool logarithmic = false;
  std::vector<double> ticks;        ///< with a number
  std::vector<double> minor_ticks;  ///< without; logarithmic axes only
  std::vector<std::string> labels;  ///< one per tick

  /// 0 at `low` and 1 at `high`.
  double share_of(double value) const;
};

/// An axis that holds low..high, divided by 1, 2 or 5 times a power of ten into at most `max_ticks` pieces.
/// @param max_ticks  at least 2. A range without length is widened.
Axis linear_axis(double low, double high, int max_ticks);

/// An axis of whole powers of ten; of less than two decades the numbers 2 and 5 are written, too.
/// @pre 0 < low <= high.
Axis logarithmic_axis(double low, double high);

}  // namespace stairway::evaluation
