// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "drivers/scip/clock_mapping.hpp"
#include "drivers/scip/scip_events.hpp"
#include "drivers/scip/scip_options.hpp"
#include "drivers/scip/stamp_unwrapper.hpp"
#include "drivers/scip/sync_pulses.hpp"
#include "drivers/scip/time_reading.hpp"
#include "drivers/types.hpp"

namespace stairway::drivers {

/// Gives scans their place in host time: carries the counter past its wrap, maps it by arrivals or by sync pulses, and
/// notes stamps that cannot be right.
class ScanClock {
 public:
  explicit ScanClock(const ScipOptions& options);

  /// The sensor's counter was set to 0 on purpose.
  void expect_reset();
  /// Scans will come from this sensor, and in this rhythm.
  void begin_stream(const SensorParameters& sensor);

  /// Makes a scan of raw values whose first byte came at `arrival_ns`.
  /// @param is_arrival_exact  false when the arrival may be another scan's.
  LaserScan to_scan(const RawScan& raw, const ScanRequest& request, const SensorParameters& sensor,
                    HostStamp arrival_ns, bool is_arrival_exact);
  /// What was wrong with stamps since the last call.
  std::vector<ScipTroubleEvent> take_troubles();

  /// The counter as TM1 tells it, on the line of the scans' stamps [ms].
  std::int64_t unwrap(std::uint32_t raw_ms) { return unwrapper_.unwrap(raw_ms).stamp_ms; }
  /// As ClockMapping::use.
  void use(const ClockReading& reading) { mapping_.use(reading); }
  /// As SyncPulses::add.
  void add_pulse(HostStamp pulse_ns) { pulses_.add(pulse_ns); }

  ClockQuality quality() const;

 private:
  std::int64_t take_stamp(std::uint32_t raw_ms);
  ScanTime place(std::int64_t device_stamp_ms, HostStamp arrival_ns, bool is_arrival_exact);
  void check_end(const LaserScan& scan, HostStamp arrival_ns);
  void check_pulses();

  StampReference reference_;
  int skip_scan_;
  StampUnwrapper unwrapper_;
  ClockMapping mapping_;
  SyncPulses pulses_;
  std::int64_t last_stamp_ms_ = -1;
  int repeated_stamps_ = 0;
  int future_scans_ = 0;               // in a row
  bool is_misplacement_told_ = false;  // of this stream
  std::vector<ScipTroubleEvent> troubles_;
};

}  // namespace stairway::drivers
