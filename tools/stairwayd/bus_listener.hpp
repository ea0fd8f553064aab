// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <stop_token>
#include <string>
#include <thread>
#include <vector>

#include "ipc/bus.hpp"

namespace stairway::daemon {

/// Listens to channels of an LCM bus that need not be there yet: opening is tried again until it succeeds, at first
/// after 0.5 s, then less often, at last every 5 s. Failures are logged. Has a thread of its own, named listener.
class BusListener {
 public:
  /// @param handler  called by the thread; must not throw.
  BusListener(std::string url, std::vector<std::string> channels, ipc::MessageHandler handler);
  /// Waits for the handler. Where multicast is blocked this takes up to 10 s.
  ~BusListener() = default;
  BusListener(const BusListener&) = delete;
  BusListener& operator=(const BusListener&) = delete;

 private:
  void run(const std::stop_token& stop);
  void listen(const std::stop_token& stop);

  const std::string url_;
  const std::vector<std::string> channels_;
  const ipc::MessageHandler handler_;
  std::jthread thread_;
};

}  // namespace stairway::daemon
