// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>

#include "drivers/types.hpp"
#include "ipc/channels.hpp"
#include "ipc/messages.hpp"
#include "scan_assembly/angle_track.hpp"
#include "tools/stairwayd/measurement_source.hpp"
#include "tools/stairwayd/publish.hpp"

namespace stairway::daemon {

/// The gravest thing that is wrong with the disk.
struct DiskProblem {
  ipc::DiskFault fault = ipc::DiskFault::None;
  std::string text;

  bool operator==(const DiskProblem&) const = default;
};

/// Sends every scan as soon as the disk angle at its last beam is known, every angle in front of the scan that needs
/// it, and the disk's angle ten times in a second of measurement time.
class MeasurementPublisher {
 public:
  using Utime = std::function<std::int64_t(drivers::HostStamp)>;

  MeasurementPublisher(ipc::Channels channels, Publish publish, Utime utime_us);

  /// Of more than 40 scans that wait for their angle, the oldest is sent without.
  void add(drivers::LaserScan scan, const scan::AngleTrack& track);
  /// The samples are in `track` already.
  void add(std::span<const drivers::AngleSample> samples, const scan::AngleTrack& track);
  /// What a device's state means for the disk goes out with the disk's angle, and at once when it changes.
  void note(const SourceState& state, const scan::AngleTrack& track);

  /// The instant of a stamp by the clocks as they were at the newest scan that was sent, so that whoever has that
  /// message can tell it as well.
  std::int64_t utime_us(drivers::HostStamp stamp_ns);

 private:
  void read_clocks(drivers::HostStamp stamp_ns) { offset_us_ = utime_us_(stamp_ns) - stamp_ns / 1000; }
  void send_known(const scan::AngleTrack& track);
  void send_oldest(const scan::AngleTrack& track);
  void send_angles();
  void send(const drivers::AngleSample& sample, const scan::AngleTrack& track);
  DiskProblem disk_problem() const;

  ipc::Channels channels_;
  Publish publish_;
  Utime utime_us_;
  std::optional<std::int64_t> offset_us_;
  std::deque<drivers::LaserScan> waiting_;
  ipc::AnglesMessage angles_;  // not sent yet
  std::optional<drivers::HostStamp> last_disk_ns_;
  drivers::AngleSample last_sample_;
  std::map<Device, std::string> failures_;
  std::int64_t index_count_ = 0;
};

}  // namespace stairway::daemon
