// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "drivers/option_range.hpp"

namespace stairway::drivers {
namespace {

std::string text(double value) {
  std::string out = std::to_string(value);
  out.erase(out.find_last_not_of('0') + 1);
  if (out.back() == '.') out.pop_back();
  return out;
}

}  // namespace

std::string range_problem(std::span<const OptionRange> ranges) {
  for (const OptionRange& range : ranges) {
    if (range.value >= range.low && range.value <= range.high) continue;
    return std::string(range.name) + " must lie between " + text(range.low) + " and " + text(range.high);
  }
  return {};
}

}  // namespace stairway::drivers
