// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <deque>
#include <optional>

#include "drivers/canopen/motor_events.hpp"
#include "drivers/canopen/motor_options.hpp"

namespace stairway::drivers {

/// Puts the two halves of the drive's feedback together, which it sends after each SYNC, and dates them by that SYNC.
class FeedbackAssembler {
 public:
  explicit FeedbackAssembler(const MotorOptions& options)
      : units_(options), standstill_rad_s_(options.standstill_speed_rad_s) {}

  void on_sync(HostStamp sent_ns);
  /// Statusword and actual velocity.
  void on_status(std::uint16_t statusword, std::int32_t velocity, HostStamp arrival_ns);
  void on_position(std::int32_t position, HostStamp arrival_ns);
  /// The feedback, once both halves of one SYNC are there.
  std::optional<DriveFeedback> take();

  /// Forgets SYNCs and halves, but not how often the position has overflowed.
  void pause();
  /// The drive counts from anew.
  void forget_position() { counts_.reset(); }

 private:
  std::optional<HostStamp> sync_before(HostStamp arrival_ns) const;

  MotorUnits units_;
  double standstill_rad_s_;
  std::deque<HostStamp> syncs_ns_;
  std::optional<HostStamp> status_sync_ns_;
  std::optional<HostStamp> position_sync_ns_;
  std::optional<std::int64_t> counts_;  // not wrapped
  DriveFeedback feedback_;
};

}  // namespace stairway::drivers
