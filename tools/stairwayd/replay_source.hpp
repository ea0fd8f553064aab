// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "tools/recording/recorded_measurements.hpp"
#include "tools/stairwayd/measurement_source.hpp"

namespace stairway::daemon {

/// A recording, played from its beginning to its end. Nothing is left out: a slow detector makes it wait.
///
/// The same settings give the same answers as the run that was recorded, to the last bit, provided that its detector
/// left out no sweep and that the recording began with the daemon.
class ReplaySource final : public MeasurementSource {
 public:
  /// @param speed  recorded seconds per second; 0 is as fast as possible. Pauses of more than 10 s are cut short.
  /// @param previews  as tools::recorded_previews() tells them; empty leaves them to the settings.
  static tl::expected<std::unique_ptr<ReplaySource>, ipc::LogError> open(
      const std::filesystem::path& path, const tools::RecordingFacts& facts, double speed,
      std::optional<std::vector<std::int64_t>> previews = std::nullopt);

  std::vector<SourceEvent> read(std::chrono::milliseconds timeout) override;
  std::string order(const DiskOrder&) override { return "this daemon plays a recording"; }
  void stop() override {}
  std::int64_t utime_us(drivers::HostStamp stamp_ns) const override { return recording_.utime_us(stamp_ns); }
  bool waits_for_detector() const override { return true; }
  std::optional<std::vector<std::int64_t>> previews() const override { return previews_; }
  bool has_ended() const override { return has_ended_; }

 private:
  using Clock = std::chrono::steady_clock;

  ReplaySource(std::string name, tools::RecordedMeasurements recording, double speed,
               std::optional<std::vector<std::int64_t>> previews);
  std::optional<tools::RecordedMeasurements::Entry> take_due(Clock::time_point limit);
  void end(std::vector<SourceEvent>& events);

  std::string name_;
  tools::RecordedMeasurements recording_;
  double speed_;
  std::optional<std::vector<std::int64_t>> previews_;
  bool is_begun_ = false;
  bool has_ended_ = false;
  std::optional<tools::RecordedMeasurements::Entry> next_;
  std::optional<std::int64_t> last_utime_us_;
  Clock::time_point due_;
};

}  // namespace stairway::daemon
