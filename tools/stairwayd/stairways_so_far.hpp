// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "ipc/messages.hpp"

namespace stairway::daemon {

/// What the previews of one sweep have shown. A stairway that one of them confirmed stays as it was last seen, with the
/// instant of that: a later one may cut it at a worse place, and only the whole sweep can tell that there is none.
class StairwaysSoFar {
 public:
  /// Adds to a preview what earlier ones of its sweep showed and it does not, behind its own.
  /// @pre  its stairways have their track ids.
  void complete(ipc::StairwaysMessage& preview);

  /// The final answer of the sweep is there.
  void forget() { seen_.clear(); }

 private:
  struct Seen {
    std::int64_t track_id;
    std::int64_t utime_us;
    detect::Stairway stairway;
  };
  std::int64_t sweep_ = -1;
  std::vector<Seen> seen_;
};

}  // namespace stairway::daemon
