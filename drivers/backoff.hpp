// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>

#include "drivers/types.hpp"

namespace stairway::drivers {

/// Pause before the next attempt after `failures` in a row: `min_s` after the first, doubled by each further one up to
/// `max_s`. Any number of failures is fine; below 1 counts as 1.
inline HostStamp backoff_ns(int failures, double min_s, double max_s) {
  const int doublings = std::clamp(failures - 1, 0, 30);
  return std::llround(1e9 * std::min(max_s, std::ldexp(min_s, doublings)));
}

}  // namespace stairway::drivers
