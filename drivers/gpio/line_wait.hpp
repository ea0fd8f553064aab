// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <span>

namespace stairway::drivers {

/// How soon to look again while an edge waits for older ones.
inline constexpr std::chrono::nanoseconds kSettlingWait = std::chrono::milliseconds(1);

/// Waits at most `timeout`, to the microsecond, until one of the line requests can be read. False when their chip has
/// gone. At most eight.
bool wait_for_lines(std::span<const int> fds, std::chrono::nanoseconds timeout);

}  // namespace stairway::drivers
