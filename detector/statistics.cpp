// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "detector/statistics.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace stairway::detect {
namespace {

constexpr double kSigmaPerMedianDeviation = 1.4826;  // of a normal distribution

double nth_smallest(std::vector<double>& values, std::size_t n) {
  assert(n < values.size());
  const auto place = values.begin() + static_cast<std::ptrdiff_t>(n);
  std::nth_element(values.begin(), place, values.end());
  return *place;
}

}  // namespace

double median(std::vector<double> values) { return nth_smallest(values, values.size() / 2); }

double robust_deviation(std::vector<double> values, double center) {
  for (double& value : values) value = std::abs(value - center);
  return kSigmaPerMedianDeviation * nth_smallest(values, values.size() / 2);
}

double outer_quartile(std::vector<double> values, bool from_above) {
  const std::size_t from_outside = (values.size() - 1) / 4;
  return nth_smallest(values, from_above ? values.size() - 1 - from_outside : from_outside);
}

}  // namespace stairway::detect
