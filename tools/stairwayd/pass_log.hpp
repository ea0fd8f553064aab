// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <set>

#include "tools/stairwayd/pipeline.hpp"

namespace stairway::daemon {

/// Logs the answers: stairways that come and go as information, every pass with its timings for debugging. Previews
/// tell a stairway once, before the final answer does.
class PassLog {
 public:
  void add(const Pass& pass);

 private:
  void add_preview(const Pass& pass);
  void add_answer(const Pass& pass);

  bool is_first_ = true;
  std::set<std::int64_t> seen_;       // track ids of the last answer,
  std::set<std::int64_t> previewed_;  // and of the previews since then
};

}  // namespace stairway::daemon
