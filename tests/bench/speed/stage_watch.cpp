// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/bench/speed/stage_watch.hpp"

#include <ctime>

namespace stairway::bench {
namespace {

double now_ms(clockid_t clock) {
  timespec now{};
  clock_gettime(clock, &now);
  return 1e3 * static_cast<double>(now.tv_sec) + 1e-6 * static_cast<double>(now.tv_nsec);
}

}  // namespace

void StageWatch::begin(std::string_view stage) {
  stop();
  costs_.push_back({.name = std::string(stage)});
  is_running_ = true;
  wall_ms_ = now_ms(CLOCK_MONOTONIC);
  cpu_ms_ = now_ms(CLOCK_PROCESS_CPUTIME_ID);
}

void StageWatch::stop() {
  if (is_running_) {
    costs_.back().wall_ms = now_ms(CLOCK_MONOTONIC) - wall_ms_;
    costs_.back().cpu_ms = now_ms(CLOCK_PROCESS_CPUTIME_ID) - cpu_ms_;
  }
  is_running_ = false;
}

}  // namespace stairway::bench
