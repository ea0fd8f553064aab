// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

#include "config/settings.hpp"
#include "scan_assembly/sweep_assembler.hpp"

namespace stairway::daemon {

/// Says when a sweep under way is worth an answer of its own. It goes by the times and angles of the measurements
/// alone, so the same measurements give the same previews.
///
/// In the first half of a turn every direction is seen once. What is seen in the second half is known more precisely
/// then, and previews come four times as rarely. There is none before 20000 points, none while the disk hardly turns,
/// and none in the last tenth of a turn, where the final answer is near.
class PreviewSchedule {
 public:
  explicit PreviewSchedule(const config::PreviewOptions& options);

  /// Whether it is time for a preview, which is then taken for made. Call it as the sweep grows: a preview that was due
  /// while nobody asked is due when somebody does.
  bool take_due(const scan::Sweep& so_far);

 private:
  const drivers::HostStamp every_ns_;
  std::optional<std::uint64_t> sweep_;  // that was asked about last
  drivers::HostStamp last_ns_ = 0;      // end of its newest preview
  double last_angle_rad_ = 0.0;         // covered by it
};

}  // namespace stairway::daemon
