// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <string>
#include <string_view>

#include "detector/stairway_detector.hpp"
#include "ipc/stairway_json.hpp"

namespace stairway::tools {

/// A stopwatch for the stages of one detection, by the machine's steady clock.
///
///     StageTimer timer;                                             // the points are in memory
///     detection = detect_stairways(cloud, options, timer.listener());
///     timer.stop();
///     timer.timings();                                              // total, then the stages in their order
class StageTimer {
 public:
  /// Starts the total.
  StageTimer() : start_(Clock::now()), stage_start_(start_) {}

  /// Ends the stage that runs, if any, and begins another one; stages of the same name are added up.
  void begin(std::string_view stage) {
    close_stage(Clock::now());
    stage_ = std::string(stage);
  }

  /// Ends the stage that runs, and the total.
  void stop() {
    const Clock::time_point now = Clock::now();
    close_stage(now);
    stage_.clear();
    total_ms_ = ms(start_, now);
  }

  /// Calls begin(); the timer must outlive it.
  detect::StageListener listener() {
    return [this](std::string_view stage) { begin(stage); };
  }

  double total_ms() const { return total_ms_; }  ///< 0 before stop()

  /// "total" and the stages that have ended, in the order of their first beginning [ms].
  ipc::Timings timings() const {
    ipc::Timings all{{"total", total_ms_}};
    all.insert(all.end(), stages_.begin(), stages_.end());
    return all;
  }

 private:
  using Clock = std::chrono::steady_clock;

  static double ms(Clock::time_point from, Clock::time_point to) {
    return std::chrono::duration<double, std::milli>(to - from).count();
  }

  void close_stage(Clock::time_point now) {
    if (!stage_.empty()) add(stage_, ms(stage_start_, now));
    stage_start_ = now;
  }

  void add(const std::string& stage, double duration_ms) {
    for (auto& [name, sum_ms] : stages_) {
      if (name != stage) continue;
      sum_ms += duration_ms;
      return;
    }
    stages_.emplace_back(stage, duration_ms);
  }

  Clock::time_point start_;
  Clock::time_point stage_start_;
  std::string stage_;
  double total_ms_ = 0.0;
  ipc::Timings stages_;
};

}  // namespace stairway::tools
