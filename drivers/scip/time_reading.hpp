// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

#include "drivers/types.hpp"

namespace stairway::drivers {

/// The sensor's counter at an instant of the host, known to half the round trip.
struct ClockReading {
  std::int64_t device_stamp_ms = 0;  ///< unwrapped [ms]
  HostStamp host_ns = 0;             ///< middle of the round trip [ns]
  std::int64_t round_trip_ns = 0;    ///< from asking to the answer's arrival [ns]
};

/// Collects TM1 round trips and keeps the shortest, which is the one that waited least.
class TimeReadings {
 public:
  void clear() { *this = {}; }
  void ask(HostStamp now_ns) { asked_ns_ = now_ns; }
  void answer(std::int64_t device_stamp_ms, HostStamp arrival_ns) {
    const std::int64_t round_trip_ns = arrival_ns - asked_ns_;
    ++count_;
    if (best_ && best_->round_trip_ns <= round_trip_ns) return;
    best_ = ClockReading{device_stamp_ms, asked_ns_ + round_trip_ns / 2, round_trip_ns};
  }

  int count() const { return count_; }
  const std::optional<ClockReading>& best() const { return best_; }

 private:
  HostStamp asked_ns_ = 0;
  int count_ = 0;
  std::optional<ClockReading> best_;
};

}  // namespace stairway::drivers
