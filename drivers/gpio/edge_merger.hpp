// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "drivers/ports/edge_port.hpp"

namespace stairway::drivers {

/// Puts edges of several lines into the order of their stamps. Lines have queues or interrupt threads of their own, so
/// an edge may be read after a later one of another line; edges therefore wait until all older ones must have come.
class EdgeMerger {
 public:
  /// How long an interrupt may take from its stamp to the queue [ns].
  static constexpr HostStamp kSettling_ns = 1'000'000;

  void add(const Edge& edge) { waiting_.push_back(edge); }
  bool is_empty() const { return waiting_.empty(); }

  /// The edges that are complete, given that all lines were read out at or after `read_ns`. `complete_ns` never goes
  /// back. O(n log n) in the edges that wait.
  EdgeBatch release(HostStamp read_ns);

 private:
  std::vector<Edge> waiting_;
  HostStamp complete_ns_ = 0;
};

}  // namespace stairway::drivers
