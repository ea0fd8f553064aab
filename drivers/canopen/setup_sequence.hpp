// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <limits>
#include <optional>
#include <vector>

#include "drivers/canopen/motor_events.hpp"
#include "drivers/canopen/motor_setup.hpp"
#include "drivers/canopen/sdo_client.hpp"

namespace stairway::drivers {

/// Goes through the set-up of a drive, one object at a time: checks what it is, waits for its mode, and tolerates what
/// it can be driven without.
class SetupSequence {
 public:
  enum class Progress { Going, Done, Failed };
  struct Advance {
    Progress progress = Progress::Going;
    std::optional<MotorTroubleEvent> trouble;  ///< also while going on without an object
  };

  explicit SetupSequence(const MotorOptions& options);

  /// From the first object, whatever was under way. @pre  !sdo.is_busy().
  void begin(SdoClient& sdo, HostStamp now_ns);
  Advance on_result(SdoClient& sdo, const SdoResult& result, HostStamp now_ns);
  void on_time(SdoClient& sdo, HostStamp now_ns);
  HostStamp deadline() const { return pause_end_ns_; }

  /// What has been read; complete when done.
  const DriveInfo& drive() const { return drive_; }

 private:
  void request(SdoClient& sdo, HostStamp now_ns);
  Advance refuse(const SdoResult& result) const;
  std::optional<MotorTroubleEvent> take(const SdoResult& result);

  std::vector<SetupStep> steps_;
  HostStamp mode_timeout_ns_;
  std::size_t next_ = 0;
  HostStamp mode_deadline_ns_ = 0;
  HostStamp pause_end_ns_ = std::numeric_limits<HostStamp>::max();
  DriveInfo drive_;
};

}  // namespace stairway::drivers
