// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "drivers/canopen/feedback_assembler.hpp"

#include <algorithm>
#include <cmath>

#include "drivers/canopen/cia402.hpp"

namespace stairway::drivers {
namespace {

constexpr std::size_t kMaxSyncs = 16;

}  // namespace

void FeedbackAssembler::on_sync(HostStamp sent_ns) {
  syncs_ns_.push_back(sent_ns);
  if (syncs_ns_.size() > kMaxSyncs) syncs_ns_.pop_front();
}

void FeedbackAssembler::on_status(std::uint16_t word, std::int32_t velocity, HostStamp arrival_ns) {
  status_sync_ns_ = sync_before(arrival_ns);
  feedback_.speed_rad_s = units_.speed_rad_s(velocity);
  const bool says_standstill = decode_statusword(word) == DriveState::Enabled && (word & statusword::kStandstill) != 0;
  feedback_.is_moving = !says_standstill && std::abs(feedback_.speed_rad_s) > standstill_rad_s_;
}

void FeedbackAssembler::on_position(std::int32_t position, HostStamp arrival_ns) {
  position_sync_ns_ = sync_before(arrival_ns);
  if (!counts_) counts_ = position;
  // The difference of 32-bit counters is right across their overflow.
  const std::uint32_t ahead = static_cast<std::uint32_t>(position) - static_cast<std::uint32_t>(*counts_);
  *counts_ += static_cast<std::int32_t>(ahead);
  feedback_.angle_rad = units_.angle_rad(*counts_);
}

std::optional<DriveFeedback> FeedbackAssembler::take() {
  if (!status_sync_ns_ || status_sync_ns_ != position_sync_ns_) return std::nullopt;
  feedback_.stamp_ns = *status_sync_ns_;
  status_sync_ns_.reset();
  position_sync_ns_.reset();
  return feedback_;
}

void FeedbackAssembler::pause() {
  syncs_ns_.clear();
  status_sync_ns_.reset();
  position_sync_ns_.reset();
}

std::optional<HostStamp> FeedbackAssembler::sync_before(HostStamp arrival_ns) const {
  const auto after = std::ranges::upper_bound(syncs_ns_, arrival_ns);
  return after == syncs_ns_.begin() ? std::nullopt : std::optional(*std::prev(after));
}

}  // namespace stairway::drivers
