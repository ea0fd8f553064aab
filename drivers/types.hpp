// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

namespace stairway::drivers {

/// Host time in nanoseconds on one monotonic time line (CLOCK_MONOTONIC, or the simulation's own).
using HostStamp = std::int64_t;

/// What a beam has to say; only `Ok` carries a distance.
enum class BeamStatus : std::uint8_t {
  Ok,         ///< a distance within the sensor's range
  NoReturn,   ///< nothing in range (SCIP error distance 1, or beyond DMAX)
  TooNear,    ///< an object nearer than the sensor can measure (SCIP error distances 2 and 4)
  Disturbed,  ///< measurement error, perhaps interference (SCIP error distance 3)
  Invalid,    ///< any other value below DMIN
};

/// One mirror turn. Entry i was measured at `first_beam_stamp_ns + i * beam_interval_ns`, in the direction
/// `first_angle_rad + i * angle_increment_rad` of the `lidar` frame (counter-clockwise about z, 0 along x).
struct LaserScan {
  std::uint64_t sequence = 0;              ///< number of the mirror turn since the stream began; gaps are lost scans
  std::int64_t device_stamp_ms = 0;        ///< the sensor's counter, unwrapped past 24 bits [ms]
  HostStamp first_beam_stamp_ns = 0;       ///< host time at which entry 0 was measured [ns]
  double beam_interval_ns = 0.0;           ///< time between neighbouring entries [ns]
  double first_angle_rad = 0.0;            ///< direction of entry 0 [rad]
  double angle_increment_rad = 0.0;        ///< direction step between neighbouring entries [rad]
  std::vector<float> ranges_m;             ///< distances [m]; NaN unless the status is Ok
  std::vector<BeamStatus> statuses;        ///< same length as `ranges_m`
  std::vector<std::uint32_t> intensities;  ///< strength of each echo as the sensor tells it, unit-less, 0 to about
                                           ///< 16000; same length, or empty when not asked for
};

/// The disk's angle at one instant.
struct AngleSample {
  HostStamp stamp_ns = 0;  ///< host time [ns]
  double angle_rad = 0.0;  ///< angle since the index of the first turn, counter-clockwise from above, not wrapped [rad]
  bool valid = false;      ///< false before the first index and after a fault, until the next index
};

}  // namespace stairway::drivers
