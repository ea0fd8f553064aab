// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <vector>

#include "detector/statistics.hpp"

namespace stairway::bench {

/// The median of a figure over some runs.
template <class Run, class Figure>
double median_of(const std::vector<Run>& runs, const Figure& figure) {
  std::vector<double> values;
  for (const Run& run : runs) values.push_back(std::invoke(figure, run));
  return detect::median(std::move(values));
}

}  // namespace stairway::bench
