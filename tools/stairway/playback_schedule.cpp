// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "tools/stairway/playback_schedule.hpp"

#include <algorithm>

namespace stairway::tools {
namespace {

constexpr double kLongestPause_s = 10.0;

}  // namespace

void PlaybackSchedule::next(std::int64_t utime_us, Time now) {
  const double passed_s = 1e-6 * static_cast<double>(utime_us - last_utime_us_.value_or(utime_us));
  const double step_s = rate_ > 0.0 ? std::clamp(passed_s, 0.0, kLongestPause_s) / rate_ : 0.0;
  const auto step = std::chrono::duration_cast<Duration>(std::chrono::duration<double>(step_s));
  last_utime_us_ = utime_us;
  is_stepping_ = false;
  if (left_when_paused_) {
    left_when_paused_ = step;
  } else {
    due_ = due_.value_or(now) + step;
  }
}

bool PlaybackSchedule::is_due(Time now) const { return is_stepping_ || left(now) == Duration::zero(); }

PlaybackSchedule::Duration PlaybackSchedule::left(Time now) const {
  if (is_paused()) return Duration::max();
  return std::max(Duration::zero(), due_.value_or(now) - now);
}

void PlaybackSchedule::pause(Time now) {
  if (!is_paused()) left_when_paused_ = left(now);
}

void PlaybackSchedule::resume(Time now) {
  if (!is_paused()) return;
  due_ = now + *left_when_paused_;
  left_when_paused_.reset();
}

}  // namespace stairway::tools
