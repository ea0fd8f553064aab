// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

/// The files that lcm-logger writes and lcm-logplayer plays: events one after the other, without header or index. An
/// event is, big endian, the magic number, int64 number of the event, int64 instant, int32 length of the channel's
/// name, int32 length of the message, then the name without a closing NUL and the message.
namespace stairway::ipc {

inline constexpr std::uint32_t kLogMagic = 0xEDA1DA01;
inline constexpr std::size_t kLogHeaderBytes = 28;
inline constexpr std::size_t kMaxLogChannelLength = 63;       ///< as LCM has it
inline constexpr std::size_t kMaxLogMessageBytes = 32 << 20;  ///< a longer one is taken for damage

/// A message with the instant it was received; names and bytes belong to someone else.
struct LogEvent {
  std::int64_t number = 0;    ///< counts from 0 in a file
  std::int64_t utime_us = 0;  ///< microseconds since the epoch
  std::string_view channel;
  std::span<const std::uint8_t> bytes;
};

/// A log that cannot be opened, read or written; `text` is one line for a person.
struct LogError {
  std::string text;
  int code = 0;  ///< errno; 0 if the file is not what it should be
};

/// The same with its own memory.
struct StoredEvent {
  std::int64_t utime_us = 0;
  std::string channel;
  std::vector<std::uint8_t> bytes;

  LogEvent view(std::int64_t number = 0) const { return {number, utime_us, channel, bytes}; }
  std::size_t log_bytes() const { return kLogHeaderBytes + channel.size() + bytes.size(); }
};

/// The head of an event as it stands in the file.
struct LogHeader {
  std::int64_t number = 0;
  std::int64_t utime_us = 0;
  std::size_t channel_bytes = 0;
  std::size_t message_bytes = 0;

  std::size_t event_bytes() const { return kLogHeaderBytes + channel_bytes + message_bytes; }
};

/// The head at the beginning of `bytes`; empty if there is no magic number, if a length is impossible, or if fewer than
/// kLogHeaderBytes are there.
std::optional<LogHeader> read_log_header(std::span<const std::uint8_t> bytes);

/// Appends the event to `out` as it stands in a file.
/// @pre  the channel's name and the message are within the limits above.
void append_log_event(std::vector<std::uint8_t>& out, const LogEvent& event);

}  // namespace stairway::ipc
