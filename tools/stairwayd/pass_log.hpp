// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <set>

#include "tools/stairwayd/pipeline.hpp"

namespace stairway::daemon {

/// Logs the answers: stairways that come and go as information, every pass with its timings for debugging.
class PassLog {
 public:
  void add(const Pass& pass);

 private:
  bool is_first_ = true;
  std::set<std::int64_t> seen_;  // track ids of the last pass
};

}  // namespace stairway::daemon
