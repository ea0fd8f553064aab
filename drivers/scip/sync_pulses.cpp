// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "drivers/scip/sync_pulses.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace stairway::drivers {
namespace {

constexpr std::size_t kMaxPulses = 64;
constexpr double kMaxUnevenness = 0.05;  // of a turn
constexpr double kMaxResidual_ns = 5e6;
constexpr int kScansToLock = 40;

}  // namespace

void SyncPulses::add(HostStamp pulse_ns) {
  if (!recent_.empty() && pulse_ns <= recent_.back()) return;
  ++pulses_;
  recent_.push_back(pulse_ns);
  if (recent_.size() > kMaxPulses) recent_.pop_front();
}

std::optional<HostStamp> SyncPulses::match(HostStamp rear_ns) {
  const auto found = find(rear_ns);
  if (found) {
    const auto residual_ns = static_cast<double>(*found - rear_ns);
    run_ = std::clamp(run_ + 1, 1, kScansToLock);
    residual_ns_ += (residual_ns - residual_ns_) / (is_locked_ ? kScansToLock : run_);
  } else {
    run_ = std::clamp(run_ - 1, -kScansToLock, -1);
  }
  if (run_ == kScansToLock) is_locked_ = std::abs(residual_ns_) <= kMaxResidual_ns;
  if (run_ == -kScansToLock) is_locked_ = false;
  return found;
}

bool SyncPulses::is_misplaced() const { return run_ == kScansToLock && !is_locked_; }

std::optional<HostStamp> SyncPulses::find(HostStamp rear_ns) const {
  const HostStamp expected_ns = rear_ns + std::llround(offset_ns_);
  const auto distance_ns = [&](HostStamp pulse_ns) { return std::abs(static_cast<double>(pulse_ns - expected_ns)); };
  const auto nearest = std::ranges::min_element(recent_, {}, distance_ns);
  if (nearest == recent_.end() || nearest == recent_.begin()) return std::nullopt;
  const auto spacing_ns = static_cast<double>(*nearest - *(nearest - 1));
  const bool is_even = std::abs(spacing_ns - turn_period_ns_) <= kMaxUnevenness * turn_period_ns_;
  if (!is_even || distance_ns(*nearest) > 0.5 * turn_period_ns_) return std::nullopt;
  return *nearest - std::llround(offset_ns_);
}

}  // namespace stairway::drivers
