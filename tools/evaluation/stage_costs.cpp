// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "tools/evaluation/stage_costs.hpp"

#include <ctime>

namespace stairway::evaluation {
namespace {

double thread_time_s() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

}  // namespace

detect::StageListener StageCosts::listener() {
  return [this](std::string_view stage) { begin(stage); };
}

void StageCosts::begin(std::string_view stage) {
  stop();
  stage_ = std::string(stage);
  begun_s_ = thread_time_s();
}

void StageCosts::stop() {
  if (!stage_.empty()) seconds_[stage_] += thread_time_s() - begun_s_;
  stage_.clear();
}

double StageCosts::seconds(std::string_view stage) const {
  const auto entry = seconds_.find(stage);
  return entry == seconds_.end() ? 0.0 : entry->second;
}

double StageCosts::total_s() const {
  double sum = 0.0;
  for (const auto& [stage, seconds] : seconds_) sum += seconds;
  return sum;
}

}  // namespace stairway::evaluation
