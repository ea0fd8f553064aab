// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>

#include "drivers/types.hpp"

namespace stairway::daemon {

/// Knows whether somebody still decides about the disk: one thread notes that it has decided, another asks before it
/// lets the disk turn.
class DeadMan {
 public:
  static constexpr drivers::HostStamp kPatience_ns = 2'000'000'000;

  explicit DeadMan(drivers::HostStamp now_ns) : noted_ns_(now_ns) {}

  /// The decision is fresh.
  void note(drivers::HostStamp now_ns) {
    noted_ns_ = now_ns;
    was_missed_ = false;
  }

  /// Whether the last decision is older than `kPatience_ns`.
  bool is_missed(drivers::HostStamp now_ns) {
    if (now_ns - noted_ns_ <= kPatience_ns) return false;
    was_missed_ = true;
    return true;
  }
  /// Whether it was found missing since the last one was noted.
  bool was_missed() const { return was_missed_; }

 private:
  std::atomic<drivers::HostStamp> noted_ns_;
  std::atomic<bool> was_missed_ = false;
};

}  // namespace stairway::daemon
