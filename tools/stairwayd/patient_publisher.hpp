// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <mutex>
#include <span>
#include <string>

#include "ipc/lcm_bus.hpp"

namespace stairway::daemon {

/// Sends to an LCM bus that need not be there yet: while it cannot be opened, what is published is lost, and opening is
/// tried again by publishing, at first after 0.5 s, then less often, at last every 5 s. Failures are logged.
/// Thread-safe.
class PatientPublisher {
 public:
  explicit PatientPublisher(std::string url);

  /// False when the message could not be sent.
  bool publish(const std::string& channel, std::span<const std::uint8_t> bytes);
  /// Why the last message could not be sent; empty when it was.
  std::string trouble() const;
  /// Writes out what is buffered; what is published afterwards is lost.
  void close();

 private:
  void try_to_open();

  using Clock = std::chrono::steady_clock;
  const std::string url_;
  mutable std::mutex mutex_;
  std::unique_ptr<ipc::LcmBus> bus_;
  std::string trouble_;
  bool is_closed_ = false;
  Clock::time_point next_attempt_{};
  Clock::duration pause_;
};

}  // namespace stairway::daemon
