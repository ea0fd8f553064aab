// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>

namespace stairway::evaluation {

/// What is told about a series of values; not a number where there are too few of them.
struct Spread {
  std::size_t count = 0;
  double mean = 0.0;       ///< needs one value
  double deviation = 0.0;  ///< standard deviation of the sample; needs two
  double largest = 0.0;    ///< needs one
};

Spread spread_of(std::span<const double> values);

}  // namespace stairway::evaluation
