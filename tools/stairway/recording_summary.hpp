// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <tl/expected.hpp>
#include <vector>

#include "ipc/recording/event_log_reader.hpp"

namespace stairway::tools {

/// The messages of one channel in a recording.
struct ChannelSummary {
  std::uint64_t messages = 0;
  std::uint64_t bytes = 0;        ///< of the messages alone
  std::uint64_t undecodable = 0;  ///< of those whose type is known here
  double rate_hz = 0.0;           ///< mean, between the first and the last
  double longest_gap_s = 0.0;     ///< between two of them
};

/// What a recording holds.
struct RecordingSummary {
  std::uint64_t file_bytes = 0;
  std::uint64_t events = 0;
  std::int64_t begin_utime_us = 0;
  double duration_s = 0.0;
  std::map<std::string, ChannelSummary> channels;
  std::uint64_t lost_scans = 0;       ///< missing between others by their sequence numbers
  double turns = 0.0;                 ///< of the disk, while its angle was known
  std::uint64_t answers = 0;          ///< stairways_t messages about whole turns
  std::uint64_t previews = 0;         ///< likewise about parts of one
  std::uint64_t stairways = 0;        ///< different ones, by their track ids
  std::vector<std::string> versions;  ///< of the programs that made it, in order
  std::uint64_t settings_changes = 0;
  ipc::LogDamage damage;
};

/// Reads the whole file; any LCM log will do. One without any event is an error.
tl::expected<RecordingSummary, ipc::LogError> summarise_recording(const std::filesystem::path& path);

std::string recording_text(const std::string& name, const RecordingSummary& summary);
/// One JSON object without a line end.
std::string recording_json(const std::string& name, const RecordingSummary& summary);

}  // namespace stairway::tools
