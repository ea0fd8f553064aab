// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <mutex>
#include <variant>

#include "drivers/canopen/motor_events.hpp"
#include "drivers/encoder/encoder_events.hpp"
#include "drivers/scip/clock_mapping.hpp"
#include "drivers/scip/scip_events.hpp"
#include "tools/stairwayd/measurement_source.hpp"

namespace stairway::daemon {

/// What a device's thread has to say.
struct DeviceNews {
  drivers::HostStamp stamp_ns = 0;  ///< when it was said [ns]
  std::variant<drivers::ScipEvent, drivers::MotorEvent, drivers::EncoderEvent, drivers::ClockQuality, RawBytes> what;
};

/// Hands the devices' news to the one thread that takes them, in the order in which they were pushed. When it is too
/// slow, the oldest measurement is dropped; states and troubles stay as long as there are measurements to drop.
class DeviceQueue {
 public:
  /// @pre  capacity > 0.
  explicit DeviceQueue(std::size_t capacity) : capacity_(capacity) {}

  void push(DeviceNews news);
  /// All there is; waits at most `timeout` for the first.
  std::deque<DeviceNews> take(std::chrono::milliseconds timeout);
  /// News dropped since the last call.
  std::uint64_t take_dropped();

 private:
  void drop_one();

  const std::size_t capacity_;
  std::mutex mutex_;
  std::condition_variable arrived_;
  std::deque<DeviceNews> news_;
  std::uint64_t dropped_ = 0;
};

}  // namespace stairway::daemon
