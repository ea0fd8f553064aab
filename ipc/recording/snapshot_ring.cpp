// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "ipc/recording/snapshot_ring.hpp"

#include <utility>

#include "ipc/message_codec.hpp"

namespace stairway::ipc {
namespace {

// Angles are sent in front of the scan that needs them, a few at a time.
constexpr std::int64_t kLead_us = 200'000;

}  // namespace

SnapshotRing::SnapshotRing(Channels channels, std::size_t sweeps, std::size_t max_bytes)
    : channels_(std::move(channels)), sweeps_(sweeps), max_bytes_(max_bytes) {}

void SnapshotRing::add(StoredEvent event) {
  bytes_ += event.log_bytes();
  events_.push_back(std::move(event));
  if (events_.back().channel == channels_.stairways) {
    if (const auto answer = decode<StairwaysMessage>(events_.back().bytes); answer && answer->is_final) {
      sweep_starts_us_.push_back(answer->sweep_start_utime_us);
      if (sweep_starts_us_.size() > sweeps_) sweep_starts_us_.pop_front();
      if (sweep_starts_us_.size() == sweeps_) forget_before(sweep_starts_us_.front() - kLead_us);
    }
  }
  while (bytes_ > max_bytes_ && events_.size() > 1) forget_oldest();
}

// Health and the like bear other times than measurements do in a simulation, so scans alone decide.
void SnapshotRing::forget_before(std::int64_t utime_us) {
  std::size_t keep = 0;
  for (std::size_t i = 0; i < events_.size(); ++i) {
    if (events_[i].channel != channels_.scan) continue;
    const auto measured_us = message_utime_us(events_[i].bytes);
    if (measured_us && *measured_us >= utime_us) break;
    keep = i + 1;
  }
  for (std::size_t i = 0; i < keep; ++i) forget_oldest();
}

void SnapshotRing::forget_oldest() {
  bytes_ -= events_.front().log_bytes();
  events_.pop_front();
}

}  // namespace stairway::ipc
