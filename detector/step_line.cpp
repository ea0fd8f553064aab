// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "detector/step_line.hpp"

namespace stairway::detect {

void fit_line(const std::vector<PlacePoint>& points, StepLine& line) {
  const auto n = static_cast<double>(points.size());
  if (n < 2.0) return;
  double sum_u = 0.0, sum_v = 0.0, sum_uv = 0.0, sum_vv = 0.0;
  for (const auto& [u, v] : points) {
    const double off = u - line.value;
    sum_u += off;
    sum_v += v;
    sum_uv += off * v;
    sum_vv += v * v;
  }
  const double mean_v = sum_v / n;
  line.variance_v = sum_vv / n - mean_v * mean_v;
  if (line.variance_v > 0.0) line.turn = (sum_uv / n - sum_u / n * mean_v) / line.variance_v;
  line.value += sum_u / n - line.turn * mean_v;
}

}  // namespace stairway::detect
