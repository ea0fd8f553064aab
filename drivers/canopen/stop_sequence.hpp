// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <limits>

#include "drivers/canopen/cia402.hpp"
#include "drivers/canopen/motor_options.hpp"
#include "drivers/canopen/sdo_client.hpp"

namespace stairway::drivers {

/// Brings the disk to rest and the drive off, from any state, by objects alone: they work before the process data do.
/// Target 0 (or quick stop), standstill or `stop_timeout_s`, shutdown, disable voltage, and once the drive is off no
/// more watch over this host: a drive that stays on keeps it and brakes when this host's heartbeat ends. A drive that
/// refuses an object is asked for the next one; one that does not answer ends the sequence.
class StopSequence {
 public:
  explicit StopSequence(const MotorOptions& options);

  /// @pre  !sdo.is_busy().
  void begin(SdoClient& sdo, bool is_quick, HostStamp now_ns);
  /// @return Whether the sequence has ended.
  bool on_result(SdoClient& sdo, const SdoResult& result, HostStamp now_ns);
  void on_time(SdoClient& sdo, HostStamp now_ns);
  HostStamp deadline() const { return pause_end_ns_; }

  /// The drive said that the disk stands.
  bool is_standing() const { return is_standing_; }
  /// The drive said that it is off.
  bool is_off() const { return is_off_; }

 private:
  enum class Step : std::uint8_t { Brake, AskState, AskSpeed, Shutdown, DisableVoltage, CheckState, EndWatch };

  void request(SdoClient& sdo, Step step, HostStamp now_ns);

  MotorUnits units_;
  double standstill_rad_s_;
  HostStamp timeout_ns_;
  Step step_ = Step::Brake;
  bool is_quick_ = false;
  bool is_standing_ = false;
  bool is_off_ = false;
  HostStamp brake_end_ns_ = 0;
  HostStamp off_end_ns_ = 0;
  HostStamp pause_end_ns_ = std::numeric_limits<HostStamp>::max();
};

}  // namespace stairway::drivers
