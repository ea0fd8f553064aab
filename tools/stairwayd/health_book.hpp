// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdint>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "ipc/messages.hpp"
#include "ipc/recording/recorder.hpp"
#include "ipc/stairway_json.hpp"
#include "scan_assembly/angle_track.hpp"
#include "scan_assembly/sweep_assembler.hpp"
#include "tools/stairwayd/measurement_source.hpp"
#include "tools/stairwayd/stage_statistics.hpp"

namespace stairway::daemon {

/// What the threads of the daemon have seen, kept for the health message. Thread-safe.
class HealthBook {
 public:
  using Clock = std::chrono::steady_clock;

  explicit HealthBook(Clock::time_point now) : last_report_(now) {}

  void note(const SourceState& state);
  void note(const drivers::ClockQuality& quality);
  /// A device gave data.
  void note(const SourceSign& sign, Clock::time_point now);
  void note(drivers::DiskMode mode);
  void note_stop();
  void note(const ipc::RecorderStatus& recording);
  void note_scan(const drivers::LaserScan& scan);
  void note_angles(std::size_t samples, const scan::AngleTrack& track);
  void note_sweep(const scan::Sweep& sweep, Clock::time_point now);
  /// The detector's answer, and how long its stages took.
  void note_answer(const ipc::StairwaysMessage& answer, const ipc::Timings& timings, Clock::time_point now);
  /// Likewise of a part of a sweep, which counts as a stage of its own. It may show a stairway, but does not deny one.
  void note_preview(const ipc::StairwaysMessage& preview, const ipc::Timings& timings, Clock::time_point now);
  /// A part of the work was done once.
  void note_stage(std::string_view stage, Clock::duration duration);
  /// Why messages cannot be sent; empty when they can.
  void note_bus(std::string trouble);
  /// Something was dropped or went wrong.
  void count(const std::string& name, std::uint64_t number = 1);
  /// Something went wrong with a device; its name begins with the device's.
  void count_trouble(const SourceTrouble& trouble);

  /// The figures since the last report, and the counts since the start.
  ipc::HealthMessage report(Clock::time_point now, std::int64_t utime_us);

 private:
  struct DeviceEntry {
    Condition condition = Condition::Starting;
    std::string text;
    std::string reason;
    std::optional<Clock::time_point> last_sign;
    std::size_t signs = 0;  // since the last report
    std::int64_t troubles = 0;
  };

  /// What is wrong, for a person and for a program.
  struct Finding {
    std::string text;
    std::string reason;
  };
  std::vector<Finding> findings() const;
  std::vector<Finding> measurement_findings() const;
  std::vector<Finding> device_findings(Condition condition) const;
  ipc::DeviceHealth device_health(Device device, const DeviceEntry& entry, Clock::time_point now,
                                  double elapsed_s) const;
  ipc::ResultHealth result_health(Clock::time_point now) const;
  void note_stairways(const ipc::StairwaysMessage& answer, Clock::time_point now);

  std::mutex mutex_;
  Clock::time_point last_report_;
  std::map<Device, DeviceEntry> devices_;  // those that were told of
  std::optional<drivers::ClockQuality> clock_;
  bool is_stopped_ = false;
  drivers::DiskMode mode_ = drivers::DiskMode::Continuous;
  std::string recording_trouble_;
  std::string bus_trouble_;
  StageStatistics stages_;
  ipc::ResultHealth result_;  // without ages
  std::optional<Clock::time_point> last_sweep_;
  std::optional<Clock::time_point> last_stairway_;
  std::uint64_t scans_ = 0;   // since the last report, like
  std::uint64_t angles_ = 0;  // these
  std::int64_t sweep_ = 0;
  std::int64_t points_ = 0;
  double progress_ = 0.0;
  bool is_angle_valid_ = false;
  std::map<std::string, std::int64_t, std::less<>> counts_;
};

}  // namespace stairway::daemon
