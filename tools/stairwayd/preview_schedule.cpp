// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "tools/stairwayd/preview_schedule.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace stairway::daemon {
namespace {

constexpr std::size_t kFewestPoints = 20000;
constexpr double kLeastGrowth_rad = 0.05;
constexpr double kFirstLook_rad = 0.55 * 2.0 * std::numbers::pi;  // half a turn, and what a stairway is wide
constexpr double kLargestPart_rad = 0.9 * 2.0 * std::numbers::pi;
constexpr std::int64_t kSecondLookPause = 4;
constexpr std::int64_t kClockReading_us = 1000;  // between two readings of the clocks; scans are farther apart

}  // namespace

PreviewSchedule::PreviewSchedule(const config::PreviewOptions& options,
                                 std::optional<std::vector<std::int64_t>> recorded_us)
    : every_ns_(std::llround(1e9 * options.every_s)), recorded_us_(std::move(recorded_us)) {}

bool PreviewSchedule::take_due(const scan::Sweep& so_far, std::int64_t end_utime_us) {
  if (every_ns_ == 0) return false;
  if (sweep_ != so_far.number) {
    sweep_ = so_far.number;
    last_ns_ = planned_ns_ = so_far.begin_ns;
    last_angle_rad_ = 0.0;
  }
  // The first sweep's begin moves until the disk's angle is known.
  planned_ns_ = std::max(planned_ns_, so_far.begin_ns);
  if (so_far.end_ns == last_ns_ || !(recorded_us_ ? was_recorded(end_utime_us) : is_due(so_far))) return false;
  last_ns_ = so_far.end_ns;
  // Scans end a little after the time that was meant, which must not add up.
  planned_ns_ = so_far.end_ns - (so_far.end_ns - so_far.begin_ns) % every_ns_;
  last_angle_rad_ = so_far.statistics.covered_angle_rad;
  return true;
}

bool PreviewSchedule::was_recorded(std::int64_t end_utime_us) const {
  const auto next = std::ranges::lower_bound(*recorded_us_, end_utime_us - kClockReading_us);
  return next != recorded_us_->end() && *next <= end_utime_us + kClockReading_us;
}

bool PreviewSchedule::is_due(const scan::Sweep& so_far) const {
  const std::int64_t pause_ns = last_angle_rad_ < kFirstLook_rad ? every_ns_ : kSecondLookPause * every_ns_;
  if (so_far.end_ns - planned_ns_ < pause_ns || so_far.cloud.points.size() < kFewestPoints) return false;
  const double angle_rad = so_far.statistics.covered_angle_rad;
  return angle_rad >= last_angle_rad_ + kLeastGrowth_rad && angle_rad <= kLargestPart_rad;
}

}  // namespace stairway::daemon
