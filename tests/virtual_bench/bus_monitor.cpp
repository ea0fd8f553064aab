// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/virtual_bench/bus_monitor.hpp"

#include <poll.h>

#include <optional>
#include <stdexcept>

#include "drivers/host_clock.hpp"

namespace stairway::bench {
namespace {

constexpr int kStopCheck_ms = 50;

CanSocket open(const std::string& interface) {
  auto socket = CanSocket::open(interface);
  if (!socket) throw std::runtime_error("no interface " + interface);
  return std::move(*socket);
}

}  // namespace

BusMonitor::BusMonitor(const std::string& interface)
    : socket_(open(interface)), thread_([this](std::stop_token stop) {
        while (!stop.stop_requested()) {
          pollfd ready{socket_.descriptor(), POLLIN, 0};
          if (::poll(&ready, 1, kStopCheck_ms) <= 0) continue;
          SeenFrame seen;
          if (socket_.read(seen.frame) != CanSocket::Reading::Frame) continue;
          seen.stamp_ns = drivers::monotonic_now_ns();
          const std::lock_guard lock(mutex_);
          frames_.push_back(seen);
        }
      }) {}

std::vector<SeenFrame> BusMonitor::frames() const {
  const std::lock_guard lock(mutex_);
  return frames_;
}

}  // namespace stairway::bench
