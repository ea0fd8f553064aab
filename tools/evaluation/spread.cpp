// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "tools/evaluation/spread.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace stairway::evaluation {

Spread spread_of(std::span<const double> values) {
  constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
  const auto count = static_cast<double>(values.size());
  if (values.empty()) return {0, kUnknown, kUnknown, kUnknown};
  const double mean = std::accumulate(values.begin(), values.end(), 0.0) / count;
  double squares = 0.0;
  for (const double value : values) squares += (value - mean) * (value - mean);
  return {values.size(), mean, values.size() < 2 ? kUnknown : std::sqrt(squares / (count - 1.0)),
          *std::max_element(values.begin(), values.end())};
}

}  // namespace stairway::evaluation
