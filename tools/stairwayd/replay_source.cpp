// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "tools/stairwayd/replay_source.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <thread>
#include <utility>
#include <variant>

namespace stairway::daemon {
namespace {

using namespace std::chrono_literals;

constexpr std::chrono::microseconds kLongestPause = 10s;

}  // namespace

tl::expected<std::unique_ptr<ReplaySource>, ipc::LogError> ReplaySource::open(
    const std::filesystem::path& path, const tools::RecordingFacts& facts, double speed,
    std::optional<std::vector<std::int64_t>> previews) {
  auto recording = tools::RecordedMeasurements::open(path, facts);
  if (!recording) return tl::unexpected(recording.error());
  return std::unique_ptr<ReplaySource>(
      new ReplaySource(path.string(), std::move(*recording), speed, std::move(previews)));
}

ReplaySource::ReplaySource(std::string name, tools::RecordedMeasurements recording, double speed,
                           std::optional<std::vector<std::int64_t>> previews)
    : name_(std::move(name)), recording_(std::move(recording)), speed_(speed), previews_(std::move(previews)) {}

std::vector<SourceEvent> ReplaySource::read(std::chrono::milliseconds timeout) {
  std::vector<SourceEvent> events;
  if (!std::exchange(is_begun_, true)) {
    due_ = Clock::now();
    events.emplace_back(SourceNote{fmt::format("replaying {}", name_)});
    for (const Device device : {Device::Scanner, Device::Encoder})
      events.emplace_back(SourceState{device, Condition::Good, "from the recording", 0});
  }
  // One at a time: utime_us() is that of the message read last.
  if (auto entry = take_due(Clock::now() + timeout))
    std::visit([&](auto& measurement) { events.emplace_back(std::move(measurement)); }, entry->measurement);
  if (has_ended_) end(events);
  return events;
}

std::optional<tools::RecordedMeasurements::Entry> ReplaySource::take_due(Clock::time_point limit) {
  if (!next_) {
    next_ = recording_.next();
    has_ended_ = !next_;
    if (!next_) return std::nullopt;
    const std::int64_t passed_us = next_->utime_us - last_utime_us_.value_or(next_->utime_us);
    last_utime_us_ = next_->utime_us;
    const auto pause = std::clamp<std::chrono::microseconds>(std::chrono::microseconds(passed_us), 0us, kLongestPause);
    if (speed_ > 0.0) due_ += std::chrono::duration_cast<Clock::duration>(pause / speed_);
  }
  if (speed_ > 0.0 && Clock::now() < due_) {
    std::this_thread::sleep_until(std::min(due_, limit));
    if (Clock::now() < due_) return std::nullopt;
  }
  return std::exchange(next_, std::nullopt);
}

void ReplaySource::end(std::vector<SourceEvent>& events) {
  if (const std::string flaws = describe_flaws(recording_); !flaws.empty())
    events.emplace_back(SourceTrouble{std::nullopt, "damaged recording", fmt::format("{}: {}", name_, flaws)});
  events.emplace_back(SourceNote{fmt::format("{} has ended", name_)});
}

}  // namespace stairway::daemon
