// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <deque>
#include <limits>
#include <optional>
#include <variant>
#include <vector>

#include "drivers/types.hpp"
#include "ipc/messages.hpp"

namespace stairway::tools {

/// What the daemon took from its devices in one go.
using Measurement = std::variant<drivers::LaserScan, std::vector<drivers::AngleSample>>;

/// Brings scans and disk angles back into the order in which the daemon took them.
///
/// The daemon sends a scan only when the disk angle at its last beam is known, so behind angles that came after it;
/// every angles message says behind which scan it came. The same order gives the same sweeps, to the last bit, also
/// where scans had to do without their angles. Lost messages disturb only what they were about. Memory is bounded.
class MeasurementOrder {
 public:
  /// Messages of each kind as they were sent.
  void add(ipc::ScanMessage message);
  void add(ipc::AnglesMessage message);
  /// No more messages come.
  void end() { is_ended_ = true; }

  /// The next measurement; empty when another message must come first.
  std::optional<Measurement> next();

 private:
  bool is_angles_turn() const;

  std::deque<drivers::LaserScan> scans_;
  std::deque<ipc::AnglesMessage> angles_;
  drivers::HostStamp last_scan_ns_ = std::numeric_limits<drivers::HostStamp>::min();
  bool is_ended_ = false;
};

}  // namespace stairway::tools
