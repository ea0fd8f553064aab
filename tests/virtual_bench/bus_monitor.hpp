// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "drivers/ports/can_port.hpp"
#include "tests/virtual_bench/can_socket.hpp"

namespace stairway::bench {

/// A frame on the bus and when it was seen [ns].
struct SeenFrame {
  drivers::HostStamp stamp_ns = 0;
  drivers::CanFrame frame;
};

/// Writes down what anybody says on the bus.
class BusMonitor {
 public:
  /// Throws std::runtime_error when there is no such interface.
  explicit BusMonitor(const std::string& interface);

  std::vector<SeenFrame> frames() const;

 private:
  CanSocket socket_;
  mutable std::mutex mutex_;
  std::vector<SeenFrame> frames_;
  std::jthread thread_;
};

}  // namespace stairway::bench
