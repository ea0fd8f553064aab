// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include "drivers/types.hpp"

namespace stairway::daemon {

/// How a source is doing, told when it changes.
struct SourceState {
  bool is_delivering = false;  ///< measurements come, or are due
  std::string text;            ///< one line for a person, e.g. "scanner opening"
};

/// Something went wrong at a source; counted by name.
struct SourceTrouble {
  std::string name;    ///< one of a few, e.g. "scanner: corrupt message"
  std::string detail;  ///< for a person: what came, what was asked
};

/// What a source tells. Angle samples come in the order of their stamps, and scans likewise.
using SourceEvent = std::variant<drivers::LaserScan, std::vector<drivers::AngleSample>, SourceState, SourceTrouble>;

/// Where measurements come from: devices, the simulation, a recording. Used by one thread.
///
/// Lost devices are the source's own affair: it tries again without end and says so by its state.
class MeasurementSource {
 public:
  virtual ~MeasurementSource() = default;

  /// Waits at most `timeout` of real time for something to happen and gives what happened, in order; often nothing.
  virtual std::vector<SourceEvent> read(std::chrono::milliseconds timeout) = 0;

  /// Stops the motor, then scanning; at most about a second. Nothing is read afterwards.
  virtual void stop() = 0;

  /// The instant of a stamp in microseconds since the epoch.
  virtual std::int64_t utime_us(drivers::HostStamp stamp_ns) const = 0;
};

}  // namespace stairway::daemon
