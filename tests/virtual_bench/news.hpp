// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "ipc/lcm_bus.hpp"
#include "ipc/messages.hpp"

namespace stairway::bench {

/// What the daemon has sent over LCM so far.
struct Heard {
  std::optional<ipc::HealthMessage> health;     ///< the newest, as all of these
  std::optional<ipc::StairwaysMessage> answer;  ///< to a whole turn
  std::optional<ipc::DiskMessage> disk;
  std::int64_t healths = 0;
  std::int64_t answers = 0;  ///< likewise
  std::int64_t scans = 0;
  std::int64_t missing_scans = 0;  ///< gaps in their numbers
  std::int64_t last_sequence = -1;
  std::string damage;  ///< of messages that could not be decoded
};

/// Listens all the time, so that nothing old waits to be heard.
class News {
 public:
  News();

  Heard heard() const;
  /// Forgets what was heard.
  void clear();
  /// Waits until what was heard is enough; whether it was, in time.
  bool wait(std::chrono::seconds timeout, const std::function<bool(const Heard&)>& is_enough) const;

 private:
  template <class Message>
  void subscribe(const std::string& channel, void (News::*take)(const Message&));
  void take_health(const ipc::HealthMessage& message);
  void take_answer(const ipc::StairwaysMessage& message);
  void take_disk(const ipc::DiskMessage& message);
  void take_scan(const ipc::ScanMessage& message);

  mutable std::mutex mutex_;
  mutable std::condition_variable changed_;
  Heard heard_;
  std::unique_ptr<ipc::LcmBus> bus_;
  std::jthread thread_;
};

}  // namespace stairway::bench
