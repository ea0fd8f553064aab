// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>

#include "drivers/types.hpp"

namespace stairway::drivers {

/// CLOCK_MONOTONIC now, the time line of everything measured with hardware; the kernel stamps GPIO edges with it [ns].
inline HostStamp monotonic_now_ns() {
  static_assert(std::chrono::steady_clock::is_steady);
  return std::chrono::nanoseconds(std::chrono::steady_clock::now().time_since_epoch()).count();
}

}  // namespace stairway::drivers
