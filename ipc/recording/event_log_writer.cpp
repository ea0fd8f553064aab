// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "ipc/recording/event_log_writer.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <utility>

namespace stairway::ipc {
namespace {

constexpr std::size_t kBufferBytes = 256 << 10;

// Without this a new file may be gone after a power loss, whatever was synced of its contents.
void sync_folder(const std::filesystem::path& folder) {
  const int file = ::open(folder.empty() ? "." : folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (file < 0) return;
  ::fsync(file);
  ::close(file);
}

}  // namespace

tl::expected<EventLogWriter, LogError> EventLogWriter::create(const std::filesystem::path& path) {
  const int file = ::open(path.c_str(), O_CREAT | O_EXCL | O_WRONLY | O_CLOEXEC, 0640);
  if (file >= 0) {
    sync_folder(path.parent_path());
    return EventLogWriter(path, file);
  }
  const int code = errno;
  return tl::unexpected(LogError{fmt::format("{}: cannot be created: {}", path.string(), std::strerror(code)), code});
}

EventLogWriter::~EventLogWriter() {
  if (file_ < 0) return;
  static_cast<void>(flush());
  ::close(file_);
}

EventLogWriter::EventLogWriter(EventLogWriter&& other) noexcept
    : path_(std::move(other.path_)),
      file_(std::exchange(other.file_, -1)),
      buffer_(std::move(other.buffer_)),
      flushed_bytes_(other.flushed_bytes_),
      events_(other.events_),
      flushed_events_(other.flushed_events_) {}

EventLogWriter& EventLogWriter::operator=(EventLogWriter&& other) noexcept {
  std::swap(path_, other.path_);
  std::swap(file_, other.file_);
  std::swap(buffer_, other.buffer_);
  std::swap(flushed_bytes_, other.flushed_bytes_);
  std::swap(events_, other.events_);
  std::swap(flushed_events_, other.flushed_events_);
  return *this;
}

tl::expected<void, LogError> EventLogWriter::append(const LogEvent& event) {
  if (event.channel.empty() || event.channel.size() > kMaxLogChannelLength ||
      event.bytes.size() > kMaxLogMessageBytes) {
    return tl::unexpected(LogError{fmt::format("{}: a message of {} bytes on channel '{}' does not fit into a log",
                                               path_.string(), event.bytes.size(), event.channel)});
  }
  LogEvent numbered = event;
  numbered.number = events_++;
  append_log_event(buffer_, numbered);
  if (buffer_.size() < kBufferBytes) return {};
  return flush();
}

tl::expected<void, LogError> EventLogWriter::flush() {
  std::size_t written = 0;
  while (written < buffer_.size()) {
    const ssize_t size = ::write(file_, buffer_.data() + written, buffer_.size() - written);
    if (size < 0 && errno == EINTR) continue;
    if (size <= 0) return failure(size < 0 ? errno : ENOSPC);
    written += static_cast<std::size_t>(size);
  }
  flushed_bytes_ += buffer_.size();
  flushed_events_ = events_;
  buffer_.clear();
  return {};
}

tl::expected<void, LogError> EventLogWriter::sync() {
  if (auto flushed = flush(); !flushed) return flushed;
  if (::fdatasync(file_) != 0) return failure(errno);
  return {};
}

tl::unexpected<LogError> EventLogWriter::failure(int code) {
  buffer_.clear();
  events_ = flushed_events_;
  const auto size = static_cast<off_t>(flushed_bytes_);
  if (::ftruncate(file_, size) == 0) ::lseek(file_, size, SEEK_SET);
  return tl::unexpected(LogError{fmt::format("{}: cannot be written: {}", path_.string(), std::strerror(code)), code});
}

}  // namespace stairway::ipc
