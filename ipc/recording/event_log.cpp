// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "ipc/recording/event_log.hpp"

namespace stairway::ipc {
namespace {

std::uint64_t big_endian(std::span<const std::uint8_t> bytes) {
  std::uint64_t value = 0;
  for (const std::uint8_t byte : bytes) value = value << 8 | byte;
  return value;
}

void append_big_endian(std::vector<std::uint8_t>& out, std::uint64_t value, int bytes) {
  for (int shift = 8 * (bytes - 1); shift >= 0; shift -= 8) out.push_back(static_cast<std::uint8_t>(value >> shift));
}

}  // namespace

std::optional<LogHeader> read_log_header(std::span<const std::uint8_t> bytes) {
  if (bytes.size() < kLogHeaderBytes || big_endian(bytes.first(4)) != kLogMagic) return std::nullopt;
  LogHeader header;
  header.number = static_cast<std::int64_t>(big_endian(bytes.subspan(4, 8)));
  header.utime_us = static_cast<std::int64_t>(big_endian(bytes.subspan(12, 8)));
  header.channel_bytes = big_endian(bytes.subspan(20, 4));
  header.message_bytes = big_endian(bytes.subspan(24, 4));
  const bool is_named = header.channel_bytes >= 1 && header.channel_bytes <= kMaxLogChannelLength;
  if (!is_named || header.message_bytes > kMaxLogMessageBytes) return std::nullopt;
  return header;
}

void append_log_event(std::vector<std::uint8_t>& out, const LogEvent& event) {
  out.reserve(out.size() + kLogHeaderBytes + event.channel.size() + event.bytes.size());
  append_big_endian(out, kLogMagic, 4);
  append_big_endian(out, static_cast<std::uint64_t>(event.number), 8);
  append_big_endian(out, static_cast<std::uint64_t>(event.utime_us), 8);
  append_big_endian(out, event.channel.size(), 4);
  append_big_endian(out, event.bytes.size(), 4);
  out.insert(out.end(), event.channel.begin(), event.channel.end());
  out.insert(out.end(), event.bytes.begin(), event.bytes.end());
}

}  // namespace stairway::ipc
