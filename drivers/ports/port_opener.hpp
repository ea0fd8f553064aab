// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <string>
#include <thread>
#include <tl/expected.hpp>
#include <utility>

namespace stairway::drivers {

/// Sleeps the machine's time; false.
inline bool sleep_without_port(std::chrono::nanoseconds timeout) {
  std::this_thread::sleep_for(timeout);
  return false;
}

/// Where a device gets its port from, at the start and after each loss. Neither function may throw.
template <class Port>
struct PortOpener {
  using Open = std::function<tl::expected<std::unique_ptr<Port>, std::string>()>;
  using Wait = std::function<bool(std::chrono::nanoseconds)>;

  PortOpener(Open open_port, Wait wait_for_port = sleep_without_port)
      : open(std::move(open_port)), wait(std::move(wait_for_port)) {}

  /// Gives a port, never null, or for a person: why there is none and what to do.
  Open open;
  /// Passes the time while there is no port: at most so long, on the time line of the port's stamps. True as soon as
  /// it is worth trying `open` before the device's pause is over, e.g. because something was plugged in.
  Wait wait;
};

}  // namespace stairway::drivers
