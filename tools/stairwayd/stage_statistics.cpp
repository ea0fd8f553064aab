// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "tools/stairwayd/stage_statistics.hpp"

#include <algorithm>
#include <cmath>

namespace stairway::daemon {
namespace {

constexpr std::size_t kRuns = 100;

/// The smallest of the values that a share of them does not exceed (nearest rank).
double percentile(const std::vector<double>& sorted, double share) {
  const auto rank = static_cast<std::size_t>(std::ceil(share * static_cast<double>(sorted.size())));
  return sorted[std::max<std::size_t>(rank, 1) - 1];
}

}  // namespace

void StageStatistics::add(std::string_view stage, double duration_ms) {
  auto found = std::ranges::find(stages_, stage, &Stage::name);
  if (found == stages_.end()) found = stages_.insert(stages_.end(), Stage{std::string(stage), {}});
  found->durations_ms.push_back(duration_ms);
  if (found->durations_ms.size() > kRuns) found->durations_ms.pop_front();
}

std::vector<ipc::StageHealth> StageStatistics::report() const {
  std::vector<ipc::StageHealth> stages;
  for (const Stage& stage : stages_) {
    std::vector<double> sorted(stage.durations_ms.begin(), stage.durations_ms.end());
    std::ranges::sort(sorted);
    stages.push_back({stage.name, percentile(sorted, 0.50), percentile(sorted, 0.95)});
  }
  return stages;
}

}  // namespace stairway::daemon
