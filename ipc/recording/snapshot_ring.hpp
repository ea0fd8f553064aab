// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>

#include "ipc/channels.hpp"
#include "ipc/recording/event_log.hpp"

namespace stairway::ipc {

/// The messages of the last sweeps. A sweep has ended when its final answer is there; what came before the first beam
/// of the oldest sweep that is kept is forgotten. Sweeps of a part of a turn are kept with the whole one in front of
/// them.
class SnapshotRing {
 public:
  /// @param sweeps  how many, at least 1.
  /// @param max_bytes  the oldest messages go when they take more, whole sweeps or not.
  SnapshotRing(Channels channels, std::size_t sweeps, std::size_t max_bytes);

  void add(StoredEvent event);

  /// Oldest first.
  const std::deque<StoredEvent>& events() const { return events_; }
  std::size_t bytes() const { return bytes_; }

 private:
  void forget_before(std::int64_t utime_us);
  void forget_oldest();

  const Channels channels_;
  const std::size_t sweeps_;
  const std::size_t max_bytes_;
  std::deque<StoredEvent> events_;
  std::size_t bytes_ = 0;
  std::deque<std::int64_t> sweep_starts_us_;
};

}  // namespace stairway::ipc
