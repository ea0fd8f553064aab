// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "detector/stairway.hpp"
#include "drivers/disk/disk_options.hpp"
#include "drivers/scip/clock_mapping.hpp"
#include "drivers/types.hpp"

/// The contents of the LCM messages in the program's own types. Every `utime_us` is in microseconds since the epoch;
/// which instant it means stands at the field of the same name in ipc/types/*.lcm.
namespace stairway::ipc {

/// scan_t
struct ScanMessage {
  std::int64_t utime_us = 0;
  drivers::LaserScan scan;
  double disk_angle_start_rad = 0.0;  ///< disk angle at the first beam, not wrapped [rad]
  double disk_angle_end_rad = 0.0;    ///< disk angle at the last beam [rad]
  bool disk_angle_valid = false;
};

enum class DiskFault { None, Encoder, Motor, Disk };

/// disk_t
struct DiskMessage {
  std::int64_t utime_us = 0;
  drivers::AngleSample sample;
  double speed_rad_s = 0.0;  ///< positive counter-clockwise from above [rad/s]
  std::int64_t index_count = 0;
  DiskFault fault = DiskFault::None;
  std::string fault_text;
};

/// angles_t
struct AnglesMessage {
  std::int64_t utime_us = 0;
  /// Of the newest scan that was there when the angles were taken; before the first, the smallest number.
  drivers::HostStamp scan_stamp_ns = std::numeric_limits<drivers::HostStamp>::min();
  std::vector<drivers::AngleSample> samples;
};

/// stairways_t
struct StairwaysMessage {
  std::int64_t utime_us = 0;
  std::int64_t sweep_start_utime_us = 0;
  std::int64_t sweep = 0;
  bool is_final = true;
  detect::Detection detection;
  std::vector<std::int64_t> track_ids;       ///< one per stairway; missing ones count as 0, not tracked
  std::vector<std::int64_t> seen_utimes_us;  ///< likewise, when it was seen; missing ones count as `utime_us`
};

/// A device in health_t.
struct DeviceHealth {
  std::string name;
  std::string state;
  std::string reason;  ///< code of what is wrong; empty while it does what it is for
  bool is_ok = false;
  double rate_hz = 0.0;
  double data_age_s = -1.0;  ///< since its last data [s]; negative: there were none
  std::int64_t troubles = 0;

  bool operator==(const DeviceHealth&) const = default;
};

/// The scanner's clock in health_t; all zero before there are scans.
struct ClockHealth {
  drivers::ClockSource source = drivers::ClockSource::Passive;
  double period_ms = 0.0;         ///< measured time from scan to scan [ms]
  double latency_ms = 0.0;        ///< from the stamped instant to the first byte, as it is assumed [ms]
  double round_trip_ms = 0.0;     ///< of the question that measured it; 0: it was not [ms]
  double bound_ms = -1.0;         ///< of the error of all scans' times together; negative: not known [ms]
  double sync_residual_ms = 0.0;  ///< pulses behind the arrivals' opinion of them; 0 without [ms]
  double delay_ms = 0.0;          ///< mean lateness of the arrivals [ms]
  double residual_ms = 0.0;       ///< RMS of the device's stamps about the mapping [ms]
  double drift_ppm = 0.0;         ///< host seconds per device second, less one [1e-6]
  std::int64_t resets = 0;        ///< mappings begun anew

  bool operator==(const ClockHealth&) const = default;
};

/// How long a part of the work takes, in health_t.
struct StageHealth {
  std::string name;
  double p50_ms = 0.0;
  double p95_ms = 0.0;

  bool operator==(const StageHealth&) const = default;
};

/// The newest results in health_t.
struct ResultHealth {
  std::int64_t sweep = -1;    ///< newest that ended; -1: none did
  double sweep_age_s = -1.0;  ///< negative: none did [s]
  std::int64_t sweep_points = 0;
  std::string sweep_flaws;
  int stairways = -1;                ///< in the newest answer; -1: none yet
  std::int64_t stairway_sweep = -1;  ///< newest that showed a stairway; -1: none did
  double stairway_age_s = -1.0;      ///< since the answer about it; negative: there was none [s]

  bool operator==(const ResultHealth&) const = default;
};

/// health_t
struct HealthMessage {
  std::int64_t utime_us = 0;
  std::string state;
  std::vector<std::string> reasons;  ///< codes of what is wrong
  std::int64_t sweep = 0;
  double sweep_progress = 0.0;  ///< 0..1
  double scan_rate_hz = 0.0;
  double disk_rate_hz = 0.0;
  std::int64_t points = 0;
  std::vector<std::pair<std::string, std::int64_t>> drops;
  std::vector<DeviceHealth> devices;
  ClockHealth clock;
  std::vector<StageHealth> stages;
  ResultHealth result;
};

enum class CommandAction { Start, Stop, SingleSweep, SetSpeed, Unknown };

/// command_t
struct CommandMessage {
  std::int64_t utime_us = 0;
  std::int64_t id = 0;
  CommandAction action = CommandAction::Start;  ///< Unknown: one that this version does not know
  double speed_rad_s = 0.0;
};

enum class CommandResult { Accepted, BadValue, WrongSource, TooOld };

/// command_ack_t
struct CommandAckMessage {
  std::int64_t utime_us = 0;
  std::int64_t id = 0;
  CommandResult result = CommandResult::Accepted;
  std::string text;
  drivers::DiskMode mode = drivers::DiskMode::Continuous;
  double speed_rad_s = 0.0;

  bool operator==(const CommandAckMessage&) const = default;
};

/// cloud_slice_t
struct CloudSliceMessage {
  std::int64_t utime_us = 0;
  std::int64_t sweep_start_utime_us = 0;
  std::int64_t sweep = 0;
  std::int32_t slice = 0;
  std::int32_t slices = 1;
  std::int32_t first_point = 0;
  std::int32_t sweep_points = 0;
  std::vector<Eigen::Vector3f> points;
};

/// raw_t
struct RawMessage {
  std::int64_t utime_us = 0;
  drivers::HostStamp host_stamp_ns = 0;
  std::string device;
  bool is_sent = false;
  std::string bytes;
};

/// settings_t
struct SettingsMessage {
  std::int64_t utime_us = 0;
  std::string version;
  std::string toml;
};

}  // namespace stairway::ipc
