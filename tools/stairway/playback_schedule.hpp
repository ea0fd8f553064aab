// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>

namespace stairway::tools {

/// When the messages of a recording are due. Pure: time is an argument.
class PlaybackSchedule {
 public:
  using Time = std::chrono::steady_clock::time_point;
  using Duration = Time::duration;

  /// @param rate  recorded seconds per second; 0: everything at once.
  explicit PlaybackSchedule(double rate) : rate_(rate) {}

  /// Goes on to the next message, in the order of the recording. Pauses of more than 10 s are cut to that, and a clock
  /// that was set back while recording does not stop the playback.
  void next(std::int64_t utime_us, Time now);

  bool is_due(Time now) const;
  /// Time until it is due; 0 when it is, the longest while paused.
  Duration left(Time now) const;

  /// While paused only those messages are due that a step asks for.
  void pause(Time now);
  void resume(Time now);
  void step() { is_stepping_ = is_paused(); }
  bool is_paused() const { return left_when_paused_.has_value(); }

 private:
  double rate_;
  std::optional<std::int64_t> last_utime_us_;
  std::optional<Time> due_;
  std::optional<Duration> left_when_paused_;
  bool is_stepping_ = false;
};

}  // namespace stairway::tools
