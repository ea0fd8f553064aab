// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>

namespace stairway::daemon {

/// Knows whether acquisition and detection get on, which is what feeds systemd's watchdog.
///
/// The two threads note what they do; a third one asks. Missing devices and a robot that rests are progress: the source
/// is read all the same. A thread that hangs is none, nor is a pass that has no end.
class ProgressWatch {
 public:
  using Clock = std::chrono::steady_clock;

  /// A pass that takes longer counts as hanging.
  static constexpr std::chrono::seconds kLongestPass{60};

  /// Acquisition has read the source, whether or not that gave anything.
  void note_read() { ++reads_; }
  /// Acquisition begins, or ends, to wait for the detector on purpose.
  void note_waiting(bool is_waiting) { is_waiting_ = is_waiting; }
  void begin_pass(Clock::time_point now) { pass_began_ = now.time_since_epoch().count(); }
  void end_pass() { pass_began_ = 0; }

  /// Whether both have got on since the last call; for one thread.
  bool has_progressed(Clock::time_point now) {
    const std::uint64_t seen = reads_seen_;
    reads_seen_ = reads_;
    const Clock::duration began{pass_began_};
    const bool is_detecting = began == Clock::duration::zero() || now.time_since_epoch() - began < kLongestPass;
    return is_detecting && (reads_seen_ != seen || is_waiting_);
  }

 private:
  std::atomic<std::uint64_t> reads_ = 0;
  std::atomic<bool> is_waiting_ = false;
  std::atomic<Clock::rep> pass_began_ = 0;  // 0 between passes
  std::uint64_t reads_seen_ = 0;
};

}  // namespace stairway::daemon
