// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "config/settings.hpp"
#include "scan_assembly/sweep_assembler.hpp"

namespace stairway::daemon {

/// Says when a sweep under way is worth an answer of its own. It goes by the times and angles of the measurements
/// alone, so the same measurements give the same previews.
///
/// In the first half of a turn every direction is seen once. What is seen in the second half is known more precisely
/// then, and previews come four times as rarely. There is none before 20000 points, none while the disk hardly turns,
/// and none in the last tenth of a turn, where the final answer is near. A run that is played had its previews where it
/// had them.
class PreviewSchedule {
 public:
  /// @param recorded_us  how far sweeps had got at the previews of the run that is played, in microseconds since the
  ///   epoch, in order; empty where there is none.
  explicit PreviewSchedule(const config::PreviewOptions& options,
                           std::optional<std::vector<std::int64_t>> recorded_us = std::nullopt);

  /// Whether it is time for a preview, which is then taken for made. Call it as the sweep grows: a preview that was due
  /// while nobody asked is due when somebody does, and those after it stay where they were.
  /// @param end_utime_us  the instant of its last beam.
  bool take_due(const scan::Sweep& so_far, std::int64_t end_utime_us);

 private:
  bool was_recorded(std::int64_t end_utime_us) const;
  bool is_due(const scan::Sweep& so_far) const;

  const drivers::HostStamp every_ns_;
  const std::optional<std::vector<std::int64_t>> recorded_us_;
  std::optional<std::uint64_t> sweep_;  // that was asked about last
  drivers::HostStamp last_ns_ = 0;      // end of its newest preview,
  drivers::HostStamp planned_ns_ = 0;   // and where that was meant to be
  double last_angle_rad_ = 0.0;         // covered by it
};

}  // namespace stairway::daemon
