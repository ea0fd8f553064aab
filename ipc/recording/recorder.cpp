// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "ipc/recording/recorder.hpp"

#include <chrono>
#include <utility>

namespace stairway::ipc {
namespace {

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;

constexpr auto kWriteInterval = 100ms;
constexpr std::size_t kMaxQueuedBytes = 32 << 20;
constexpr std::size_t kMegabyte = 1'000'000;

std::string kind_of_files(RecordMode mode) { return mode == RecordMode::Snapshot ? "snapshot" : "stairway"; }

}  // namespace

Recorder::Recorder(const RecordOptions& options, const Channels& channels)
    : options_(options),
      channels_(channels),
      files_(options, kind_of_files(options.mode)),
      ring_(channels, static_cast<std::size_t>(options.snapshot_sweeps),
            static_cast<std::size_t>(options.snapshot_memory_mb) * kMegabyte),
      writer_([this](std::stop_token stop) { run(stop); }) {}

Recorder::~Recorder() { close(); }

void Recorder::add(std::string_view channel, std::span<const std::uint8_t> bytes, std::int64_t utime_us) {
  if (channel == channels_.raw && !options_.raw) return;
  // A replay makes it again; it would be twice the rest.
  if (channel == channels_.cloud) return;
  StoredEvent event{utime_us, std::string(channel), {bytes.begin(), bytes.end()}};
  const std::lock_guard lock(mutex_);
  if (is_closed_) return;
  queued_bytes_ += event.log_bytes();
  queue_.push_back(std::move(event));
  while (queued_bytes_ > kMaxQueuedBytes) {
    queued_bytes_ -= queue_.front().log_bytes();
    queue_.pop_front();
    ++overflown_events_;
  }
}

bool Recorder::request_snapshot() {
  if (options_.mode != RecordMode::Snapshot) return false;
  {
    const std::lock_guard lock(mutex_);
    is_snapshot_wanted_ = true;
  }
  wakeup_.notify_all();
  return true;
}

RecorderStatus Recorder::status() const {
  const std::lock_guard lock(mutex_);
  return status_;
}

void Recorder::close() {
  {
    const std::lock_guard lock(mutex_);
    is_closed_ = true;
  }
  writer_.request_stop();
  if (writer_.joinable()) writer_.join();
}

void Recorder::run(std::stop_token stop) {
  while (true) {
    const bool is_last = stop.stop_requested();
    std::deque<StoredEvent> events;
    bool is_snapshot_wanted = false;
    {
      std::unique_lock lock(mutex_);
      wakeup_.wait_for(lock, stop, kWriteInterval, [this] { return is_snapshot_wanted_; });
      events.swap(queue_);
      queued_bytes_ = 0;
      is_snapshot_wanted = std::exchange(is_snapshot_wanted_, false);
    }
    for (StoredEvent& event : events) write(std::move(event));
    if (is_snapshot_wanted) write_snapshot();
    is_last ? files_.end_file() : files_.keep_up(Clock::now());
    publish_status();
    if (is_last) return;
  }
}

void Recorder::write(StoredEvent event) {
  const bool is_settings = event.channel == channels_.settings;
  if (options_.mode == RecordMode::Continuous) files_.write(event.view(), Clock::now());
  if (is_settings) files_.set_preamble(event);
  if (options_.mode == RecordMode::Snapshot) ring_.add(std::move(event));
}

void Recorder::write_snapshot() {
  for (const StoredEvent& event : ring_.events()) {
    if (!files_.write(event.view(), Clock::now())) return;
  }
  files_.end_file();
  const std::lock_guard lock(mutex_);
  ++status_.snapshots;
}

void Recorder::publish_status() {
  const std::lock_guard lock(mutex_);
  status_.events = options_.mode == RecordMode::Snapshot ? ring_.events().size() : files_.events();
  status_.lost_events = overflown_events_ + files_.lost_events();
  status_.bytes = files_.bytes();
  status_.file = files_.path();
  status_.trouble = files_.trouble();
}

}  // namespace stairway::ipc
