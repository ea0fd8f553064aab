// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <tl/expected.hpp>
#include <vector>

#include "ipc/recording/event_log.hpp"

namespace stairway::ipc {

/// Writes one LCM event log.
///
/// Events are gathered until flush(), or until a quarter of a megabyte is there. When the disk takes only a part of
/// them, the file is cut back to the last flush, so it always ends with a whole event.
class EventLogWriter {
 public:
  /// Makes a new file, readable for the group; one that exists is an error.
  static tl::expected<EventLogWriter, LogError> create(const std::filesystem::path& path);

  ~EventLogWriter();
  EventLogWriter(EventLogWriter&& other) noexcept;
  EventLogWriter& operator=(EventLogWriter&& other) noexcept;

  /// An event with a bad channel or too long a message is refused. The number of the event is given here.
  tl::expected<void, LogError> append(const LogEvent& event);
  /// Hands to the system what was gathered: from then on it outlives this process.
  tl::expected<void, LogError> flush();
  /// Flushes, and waits for the disk: from then on it outlives a power loss.
  tl::expected<void, LogError> sync();

  const std::filesystem::path& path() const { return path_; }
  /// With what was not flushed yet.
  std::uint64_t bytes() const { return flushed_bytes_ + buffer_.size(); }
  std::int64_t events() const { return events_; }

 private:
  EventLogWriter(std::filesystem::path path, int file) : path_(std::move(path)), file_(file) {}
  tl::unexpected<LogError> failure(int code);

  std::filesystem::path path_;
  int file_ = -1;
  std::vector<std::uint8_t> buffer_;
  std::uint64_t flushed_bytes_ = 0;
  std::int64_t events_ = 0;
  std::int64_t flushed_events_ = 0;
};

}  // namespace stairway::ipc
