// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "ipc/recording/event_log_reader.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <cstring>
#include <span>
#include <system_error>
#include <utility>

namespace stairway::ipc {
namespace {

constexpr std::size_t kChunkBytes = 256 << 10;

tl::unexpected<LogError> unreadable(const std::filesystem::path& path, int code) {
  return tl::unexpected(LogError{fmt::format("{}: cannot be read: {}", path.string(), std::strerror(code)), code});
}

}  // namespace

tl::expected<EventLogReader, LogError> EventLogReader::open(const std::filesystem::path& path) {
  std::error_code code;
  if (std::filesystem::is_directory(path, code)) return unreadable(path, EISDIR);
  const std::uint64_t bytes = std::filesystem::file_size(path, code);
  if (code) return unreadable(path, code.value());
  errno = 0;
  std::ifstream file(path, std::ios::binary);
  if (!file) return unreadable(path, errno);
  return EventLogReader(std::move(file), bytes);
}

EventLogReader::EventLogReader(std::ifstream file, std::uint64_t file_bytes)
    : file_(std::move(file)), file_bytes_(file_bytes), chunk_(kChunkBytes) {}

std::optional<LogEvent> EventLogReader::next() {
  while (true) {
    if (auto event = parser_.next()) return event;
    if (parser_.is_ended()) return std::nullopt;
    file_.read(chunk_.data(), static_cast<std::streamsize>(chunk_.size()));
    const auto size = static_cast<std::size_t>(file_.gcount());
    if (size == 0) parser_.end();
    parser_.feed({reinterpret_cast<const std::uint8_t*>(chunk_.data()), size});
  }
}

std::string describe(const LogDamage& damage) {
  std::string text;
  const auto add = [&](const std::string& part) { text += (text.empty() ? "" : "; ") + part; };
  if (damage.places > 0)
    add(fmt::format("{} bytes at {} places are no events and were passed over", damage.skipped_bytes, damage.places));
  if (damage.lost_events > 0) add(fmt::format("{} events are missing by their numbers", damage.lost_events));
  if (damage.torn_bytes > 0)
    add(fmt::format("the last {} bytes are a torn event, as after a crash or power loss", damage.torn_bytes));
  return text;
}

}  // namespace stairway::ipc
