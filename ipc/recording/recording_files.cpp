// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "ipc/recording/recording_files.hpp"

#include <fmt/format.h>

#include <utility>

namespace stairway::ipc {
namespace {

using namespace std::chrono_literals;

constexpr auto kSyncInterval = 1s;
constexpr auto kPause = 5s;
constexpr std::uint64_t kMegabyte = 1'000'000;

std::size_t log_bytes(const LogEvent& event) { return kLogHeaderBytes + event.channel.size() + event.bytes.size(); }

}  // namespace

RecordingFiles::RecordingFiles(const RecordOptions& options, std::string kind)
    : options_(options), kind_(std::move(kind)), folder_(options.folder) {}

bool RecordingFiles::write(const LogEvent& event, Time now) {
  ++attempts_;
  if (file_ && is_full(event, now)) end_file();
  if (!file_ && !begin_file(event, now)) return false;
  return note(file_->append(event), now);
}

void RecordingFiles::keep_up(Time now) {
  if (!file_ || !note(file_->flush(), now) || now < next_sync_) return;
  next_sync_ = now + kSyncInterval;
  if (!note(file_->sync(), now)) return;
  if (!has_space()) pause(trouble_, now);
}

void RecordingFiles::end_file() {
  if (!file_) return;
  if (const auto synced = file_->sync(); !synced) trouble_ = synced.error().text;
  close_file();
}

bool RecordingFiles::begin_file(const LogEvent& event, Time now) {
  if (now < next_attempt_) return false;
  if (std::string text = folder_.make(); !text.empty()) {
    pause(std::move(text), now);
    return false;
  }
  folder_.make_room(static_cast<std::uint64_t>(options_.max_file_mb) * kMegabyte,
                    static_cast<std::uint64_t>(options_.max_total_mb) * kMegabyte);
  if (!has_space()) {
    pause(trouble_, now);
    return false;
  }
  auto file = EventLogWriter::create(folder_.next_name(kind_, event.utime_us));
  if (!file) {
    pause(std::move(file.error().text), now);
    return false;
  }
  file_ = std::move(*file);
  path_ = file_->path();
  begun_ = now;
  next_sync_ = now + kSyncInterval;
  if (!preamble_) return true;
  ++attempts_;
  LogEvent settings = preamble_->view();
  settings.utime_us = event.utime_us;
  return note(file_->append(settings), now);
}

bool RecordingFiles::is_full(const LogEvent& event, Time now) const {
  const bool is_large =
      file_->bytes() + log_bytes(event) > static_cast<std::uint64_t>(options_.max_file_mb) * kMegabyte;
  const bool is_old = std::chrono::duration<double>(now - begun_).count() >= options_.max_file_s;
  return file_->events() > 0 && (is_large || is_old);
}

bool RecordingFiles::has_space() {
  if (folder_.free_bytes() >= static_cast<std::uint64_t>(options_.min_free_mb) * kMegabyte) return true;
  trouble_ = fmt::format("{}: the disk has less than {} MB left", folder_.path().string(), options_.min_free_mb);
  return false;
}

bool RecordingFiles::note(const tl::expected<void, LogError>& done, Time now) {
  if (done) {
    trouble_.clear();
    return true;
  }
  // Without a code the event was at fault, not the file.
  if (done.error().code != 0) pause(done.error().text, now);
  return false;
}

void RecordingFiles::pause(std::string trouble, Time now) {
  trouble_ = std::move(trouble);
  next_attempt_ = now + kPause;
  close_file();
}

void RecordingFiles::close_file() {
  if (!file_) return;
  static_cast<void>(file_->flush());
  ended_bytes_ += file_->bytes();
  ended_events_ += static_cast<std::uint64_t>(file_->events());
  file_.reset();
}

}  // namespace stairway::ipc
