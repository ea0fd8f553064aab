// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <tl/expected.hpp>

#include "ipc/channels.hpp"
#include "ipc/messages.hpp"
#include "ipc/recording/event_log_reader.hpp"
#include "tools/recording/measurement_stream.hpp"

namespace stairway::tools {

/// What must be known of a recording before it is played.
struct RecordingFacts {
  std::string channel_prefix;                    ///< of the first robot in it
  std::optional<ipc::SettingsMessage> settings;  ///< the first
  bool has_scans = false;
  bool has_angles = false;
};

/// Reads as far as needed, at worst the whole file. A file without any scan is an error: there is nothing to play.
tl::expected<RecordingFacts, ipc::LogError> examine_recording(const std::filesystem::path& path);

/// The measurements of a recording, in the order in which the daemon took them.
///
/// A recording without STAIRWAY_ANGLES is played with the disk angles at the two ends of every scan.
class RecordedMeasurements {
 public:
  static tl::expected<RecordedMeasurements, ipc::LogError> open(const std::filesystem::path& path,
                                                                const RecordingFacts& facts);

  struct Entry {
    Measurement measurement;
    std::int64_t utime_us = 0;  ///< when it had been recorded, microseconds since the epoch
  };
  /// Empty at the end.
  std::optional<Entry> next();

  /// The instant of a stamp by the clocks of the newest scan that was read; by those of the first angles before one.
  std::int64_t utime_us(drivers::HostStamp stamp_ns) const { return stream_.utime_us(stamp_ns); }

  /// Complete at the end.
  const ipc::LogDamage& damage() const { return reader_.damage(); }
  std::uint64_t undecodable_messages() const { return stream_.undecodable_messages(); }

 private:
  RecordedMeasurements(ipc::EventLogReader reader, const RecordingFacts& facts);

  ipc::EventLogReader reader_;
  MeasurementStream stream_;
  std::int64_t last_utime_us_ = 0;
};

/// What is wrong with a recording that was read to its end, for a person; empty for a good one.
std::string describe_flaws(const RecordedMeasurements& recording);

}  // namespace stairway::tools
