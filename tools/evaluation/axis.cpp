// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "tools/evaluation/axis.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace stairway::evaluation {
namespace {

// Guards against quotients such as 0.3 / 0.1 that miss a whole number by rounding.
constexpr double kRounding = 1e-9;

double round_step(double length, int max_pieces) {
  const double least = length / max_pieces;
  const double power = std::pow(10.0, std::floor(std::log10(least)));
  for (const double factor : {1.0, 2.0, 5.0})
    if (factor * power * max_pieces >= length * (1.0 - kRounding)) return factor * power;
  return 10.0 * power;
}

std::string power_of_ten(int exponent) {
  static constexpr const char* kDigits[] = {"\u2070", "\u00b9", "\u00b2", "\u00b3", "\u2074",
                                            "\u2075", "\u2076", "\u2077", "\u2078", "\u2079"};
  std::string out = exponent < 0 ? "10\u207b" : "10";
  for (const char digit : std::to_string(std::abs(exponent))) out += kDigits[digit - '0'];
  return out;
}

std::string logarithmic_label(int factor, int exponent) {
  if (exponent >= -3 && exponent <= 4)
    return fmt::format("{:.{}f}", factor * std::pow(10.0, exponent), std::max(0, -exponent));
  return factor == 1 ? power_of_ten(exponent) : fmt::format("{}\u00b7{}", factor, power_of_ten(exponent));
}

}  // namespace

double Axis::share_of(double value) const {
  if (logarithmic) return std::log(value / low) / std::log(high / low);
  return (value - low) / (high - low);
}

Axis linear_axis(double low, double high, int max_ticks) {
  if (!(high > low)) {
    const double margin = low == 0.0 ? 0.5 : 0.5 * std::abs(low);
    low -= margin;
    high += margin;
  }
  double step = round_step(high - low, max_ticks - 1);
  const auto begin = [&] { return std::floor(low / step + kRounding); };
  const auto end = [&] { return std::ceil(high / step - kRounding); };
  if (end() - begin() > max_ticks - 1) step = round_step(1.01 * step * (max_ticks - 1), max_ticks - 1);
  const int digits = std::max(0, static_cast<int>(std::ceil(-std::log10(step) - kRounding)));
  Axis axis{.low = begin() * step, .high = end() * step};
  for (double i = begin(); i <= end(); i += 1.0) {
    axis.ticks.push_back(i * step);
    axis.labels.push_back(fmt::format("{:.{}f}", i * step + 0.0, digits));
  }
  return axis;
}

Axis logarithmic_axis(double low, double high) {
  const int first = static_cast<int>(std::floor(std::log10(low) + kRounding));
  const int last = std::max(first + 1, static_cast<int>(std::ceil(std::log10(high) - kRounding)));
  const bool is_short = last - first < 3;
  Axis axis{.low = std::pow(10.0, first), .high = std::pow(10.0, last), .logarithmic = true};
  for (int exponent = first; exponent <= last; ++exponent) {
    for (int factor = 1; factor < (exponent == last ? 2 : 10); ++factor) {
      const double value = factor * std::pow(10.0, exponent);
      if (factor == 1 || (is_short && (factor == 2 || factor == 5))) {
        axis.ticks.push_back(value);
        axis.labels.push_back(logarithmic_label(factor, exponent));
      } else {
        axis.minor_ticks.push_back(value);
      }
    }
  }
  return axis;
}

}  // namespace stairway::evaluation
