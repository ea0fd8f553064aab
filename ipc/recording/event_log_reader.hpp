// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <optional>
#include <tl/expected.hpp>
#include <vector>

#include "ipc/recording/event_log_parser.hpp"

namespace stairway::ipc {

/// Reads an LCM event log from its beginning, whatever damage it has; a file that is still being written is read as far
/// as it goes. Memory: the largest event and a quarter of a megabyte.
class EventLogReader {
 public:
  static tl::expected<EventLogReader, LogError> open(const std::filesystem::path& path);

  /// The next event, valid until the next call; empty at the end.
  std::optional<LogEvent> next();

  /// Complete once next() has given nothing.
  const LogDamage& damage() const { return parser_.damage(); }
  std::uint64_t events() const { return parser_.events(); }
  std::uint64_t file_bytes() const { return file_bytes_; }

 private:
  EventLogReader(std::ifstream file, std::uint64_t file_bytes);

  std::ifstream file_;
  std::uint64_t file_bytes_;
  std::vector<char> chunk_;
  EventLogParser parser_;
};

/// The damage in one sentence for a person; empty without any.
std::string describe(const LogDamage& damage);

}  // namespace stairway::ipc
