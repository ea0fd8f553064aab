// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <deque>
#include <string>
#include <string_view>
#include <vector>

#include "ipc/messages.hpp"

namespace stairway::daemon {

/// How long the parts of the work take: median and 95th percentile of the last 100 runs of each. Not thread-safe.
class StageStatistics {
 public:
  void add(std::string_view stage, double duration_ms);

  /// In the order in which the stages first ran. Cost: a sort of at most 100 numbers for each.
  std::vector<ipc::StageHealth> report() const;

 private:
  struct Stage {
    std::string name;
    std::deque<double> durations_ms;  // newest last
  };
  std::vector<Stage> stages_;
};

}  // namespace stairway::daemon
