// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>

namespace stairway::drivers {

/// What the value of an option must lie within, both ends included.
struct OptionRange {
  const char* name;
  double value, low, high;
};

/// The first value outside its range, or not a number, worded for the person editing the file; empty when none is.
std::string range_problem(std::span<const OptionRange> ranges);

}  // namespace stairway::drivers
