// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "config/settings.hpp"
#include "drivers/canopen/motor_events.hpp"
#include "drivers/disk/disk_supervisor.hpp"
#include "drivers/encoder/encoder_events.hpp"
#include "drivers/scip/scip_events.hpp"
#include "tools/stairwayd/measurement_source.hpp"
#include "tools/stairwayd/motor_rest.hpp"

namespace stairway::daemon {

/// Turns what scanner, motor and encoder tell into what the pipeline takes, says how each of them is doing, and decides
/// how fast the disk should turn. The same for real and simulated devices. No thread, clock or port.
///
/// With the drive as angle source there is no encoder, and the drive's positions become the disk's angles; they are
/// valid while the drive runs.
class DeviceWatch {
 public:
  /// @pre  settings.problem() is empty.
  explicit DeviceWatch(const config::Settings& settings);

  void take(drivers::ScipEvent event, drivers::HostStamp now_ns);
  void take(drivers::MotorEvent event, drivers::HostStamp now_ns);
  void take(drivers::EncoderEvent event, drivers::HostStamp now_ns);
  void take(const drivers::ClockQuality& quality) { events_.emplace_back(quality); }
  void take(RawBytes bytes) { events_.emplace_back(std::move(bytes)); }

  /// The disk was braked behind the watch's back, and gets up to speed again from now on.
  void expect_ramp(drivers::HostStamp now_ns) { supervisor_.expect_ramp(now_ns); }

  /// Lets time pass; call it after every batch of events and at least ten times a second.
  void pass_time(drivers::HostStamp now_ns);

  /// From now on. Scans of a disk that shall rest are left out.
  void order(const DiskOrder& order, drivers::HostStamp now_ns);

  /// What came of it, in order.
  std::vector<SourceEvent> take_events();

  /// For the motor [rad/s].
  double wanted_speed_rad_s() const { return supervisor_.wanted_speed_rad_s(); }
  /// Off while the disk shall rest; a quick stop while it is paused because it turned against the command.
  MotorWish motor_wish() const;

 private:
  struct Line {
    Condition condition = Condition::Starting;
    std::string text = "starting";
    std::string trouble;  // the last one's detail
    std::string reason;   // and its name
    drivers::HostStamp trouble_ns = 0;
  };

  void set(Device device, bool is_good, std::string text, drivers::HostStamp now_ns);
  void tell(Device device, Condition condition, std::string text, std::string reason, drivers::HostStamp now_ns);
  void report(Device device, const char* trouble, std::string detail, drivers::HostStamp now_ns);
  void add_angles(std::vector<drivers::AngleSample> samples);
  void sign(Device device, std::size_t count) { signs_[static_cast<std::size_t>(device)] += count; }
  Line& line(Device device) { return lines_[static_cast<std::size_t>(device)]; }

  drivers::DiskOptions disk_;
  drivers::DiskSupervisor supervisor_;
  bool is_turning_;
  bool is_reversed_ = false;
  std::uint64_t sequence_shift_ = 0;
  bool is_drive_running_ = false;
  std::array<Line, kDevices.size()> lines_;
  std::array<std::size_t, kDevices.size()> signs_{};  // data since the events were taken
  std::vector<SourceEvent> events_;
};

}  // namespace stairway::daemon
