// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "drivers/scip/time_reading.hpp"
#include "drivers/types.hpp"

namespace stairway::drivers {

struct ClockOptions {
  double minimum_latency_ns = 23.5e6;  ///< from the stamped instant to the first byte at the host, when nothing delays
                                       ///< it [ns], 0..1e9; measured on a UTM-30LX with firmware P.1.05 over USB
  double window_s = 6.0;               ///< scans that share one line fit [s], 0.5..60
  double max_gap_s = 1.0;              ///< a longer gap between scans starts the fit anew [s], 0.1..10
  double max_step_ns = 3e6;            ///< an arrival that much before the fit, or all of a second's arrivals that much
                                       ///< behind it, starts the fit anew [ns], 1e5..1e9

  /// First problem found, worded for the person editing the file; empty when usable.
  std::string problem() const;
};

/// Where one scan stands in host time.
struct ScanTime {
  std::uint64_t sequence = 0;  ///< number of the scan; grows by the scans lost since the one before, plus one
  HostStamp stamp_ns = 0;      ///< host time of the instant that the device stamp means [ns]
  double period_ns = 0.0;      ///< time from one scan to the next, in host time [ns]
};

/// What tells where the arrivals stand against the sensor's clock.
enum class ClockSource {
  Passive,         ///< a latency that was measured elsewhere (`minimum_latency_ns`)
  TimeAdjustment,  ///< TM1 round trips when the sensor was opened
  SyncPulse,       ///< a pulse for each turn of the mirror
};
const char* to_string(ClockSource source);

/// How good the mapping is, for health reports.
struct ClockQuality {
  ClockSource source = ClockSource::Passive;
  double latency_ms = 0.0;         ///< from the stamped instant to the first byte at the host, as it is assumed [ms]
  double round_trip_ms = 0.0;      ///< of the TM1 that was believed; 0 without [ms]
  double sync_residual_ms = 0.0;   ///< pulses behind the arrivals' opinion of them; 0 without [ms]
  double period_ms = 0.0;          ///< measured time from scan to scan [ms]
  double mean_delay_ms = 0.0;      ///< mean lateness of the arrivals behind the fit [ms]
  double stamp_residual_ms = 0.0;  ///< RMS of the device stamps about the fit; 0.29 is pure rounding [ms]
  double drift_ppm = 0.0;          ///< host seconds per device second, less one, since the last reset [1e-6]
  std::size_t scans_in_fit = 0;
  std::uint64_t resets = 0;  ///< fits begun anew: gaps, jumps, device clock set back
};

/// Maps scans to host time without asking the sensor, by a line that touches the arrivals from below.
///
/// The mirror turns evenly, so scan n was taken at a + n * period; n comes from the device stamps, which therefore need
/// only be right to half a period. Arrivals are late by a constant and by delays that are never negative, so the line
/// is laid under them as high as it goes: the edge of their lower hull below their mean, which is the line with the
/// smallest sum of delays. The device's millisecond rounding does not enter, even when its period is a whole number of
/// them. Bounded by `window_s`; O(scans in the window) for each scan, 1 us at 40 Hz and 6 s. Origin: Moon, Skelly,
/// Towsley, "Estimation and removal of clock skew", INFOCOM 1999; Olson, "A passive solution to the sensor
/// synchronization problem", IROS 2010.
class ClockMapping {
 public:
  /// @param nominal_period_ns  time between two scans as specified; the measured one stays within 2 % of it.
  ClockMapping(const ClockOptions& options, double nominal_period_ns);

  /// Takes the next scan.
  /// @param device_stamp_ms  unwrapped counter [ms].
  /// @param arrival_ns       host time of its first byte [ns].
  /// @param is_exact         false when the arrival may be another scan's: it then places the scan only for want of
  ///                         better ones.
  ScanTime add(std::int64_t device_stamp_ms, HostStamp arrival_ns, bool is_exact);

  /// Measures the latency by what the sensor's clock said at an instant of the host, as soon as enough scans came. One
  /// that is absurd (below 0 or above 100 ms) is left out.
  void use(const ClockReading& reading) { reading_ = reading; }

  /// From the stamped instant to the first byte at the host, as it is assumed [ns].
  double latency_ns() const { return latency_ns_; }

  /// Starts the fit anew; the sequence goes on, advanced by the time that passes until the next scan.
  void reset();

  /// Starts the fit anew with another period as specified [ns].
  void set_nominal_period(double nominal_period_ns);
  double nominal_period_ns() const { return nominal_period_ns_; }

  /// Costs O(scans in the window); meant for a report per second.
  ClockQuality quality() const;

 private:
  struct Arrival {
    std::int64_t turn = 0;
    std::int64_t device_stamp_ms = 0;
    HostStamp arrival_ns = 0;
    bool is_exact = false;
  };
  struct Line {
    std::int64_t turn = 0;
    HostStamp arrival_ns = 0;  // at `turn`
    double period_ns = 0.0;

    HostStamp at(std::int64_t n) const;
    double delay_ns(const Arrival& arrival) const;
  };
  struct HullPoint {
    double turns = 0.0;
    double arrival_ns = 0.0;
  };

  std::int64_t next_turn(std::int64_t device_stamp_ms, HostStamp arrival_ns);
  void drop_steps(const Arrival& arrival);
  void drop_before(std::int64_t turn);
  void build_hull();
  Line line_below() const;
  void measure_latency();
  double stamp_residual_ms() const;

  ClockOptions options_;
  double nominal_period_ns_;
  std::deque<Arrival> window_;
  std::vector<HullPoint> hull_;
  double mean_turns_ = 0.0;
  std::optional<Arrival> last_;
  std::optional<Arrival> anchor_;  // its arrival is the fitted one
  Line line_;
  std::optional<ClockReading> reading_;
  double latency_ns_;
  double round_trip_ns_ = 0.0;  // of the reading that gave the latency
  HostStamp last_on_time_ns_ = 0;
  std::uint64_t resets_ = 0;
};

}  // namespace stairway::drivers
