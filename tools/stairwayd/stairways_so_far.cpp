// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "tools/stairwayd/stairways_so_far.hpp"

#include <algorithm>
#include <utility>

namespace stairway::daemon {

void StairwaysSoFar::complete(ipc::StairwaysMessage& preview) {
  // The final answer of a sweep may have been left out.
  if (std::exchange(sweep_, preview.sweep) != preview.sweep) seen_.clear();
  std::vector<detect::Stairway>& stairways = preview.detection.stairways;
  preview.seen_utimes_us.assign(stairways.size(), preview.utime_us);
  for (const Seen& earlier : seen_) {
    if (std::ranges::find(preview.track_ids, earlier.track_id) != preview.track_ids.end()) continue;
    stairways.push_back(earlier.stairway);
    preview.track_ids.push_back(earlier.track_id);
    preview.seen_utimes_us.push_back(earlier.utime_us);
  }
  seen_.clear();
  for (std::size_t i = 0; i < stairways.size(); ++i)
    seen_.push_back({preview.track_ids[i], preview.seen_utimes_us[i], stairways[i]});
}

}  // namespace stairway::daemon
