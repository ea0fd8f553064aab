// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "drivers/gpio/edge_merger.hpp"

#include <algorithm>

namespace stairway::drivers {

EdgeBatch EdgeMerger::release(HostStamp read_ns) {
  complete_ns_ = std::max(complete_ns_, read_ns - kSettling_ns);
  std::ranges::stable_sort(waiting_, {}, &Edge::stamp_ns);
  const auto end = std::ranges::upper_bound(waiting_, complete_ns_, {}, &Edge::stamp_ns);
  EdgeBatch batch;
  batch.edges.assign(waiting_.begin(), end);
  batch.complete_ns = complete_ns_;
  waiting_.erase(waiting_.begin(), end);
  return batch;
}

}  // namespace stairway::drivers
