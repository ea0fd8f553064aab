// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "drivers/scip/clock_mapping.hpp"
#include "drivers/scip/scip_commands.hpp"
#include "drivers/scip/scip_replies.hpp"

namespace stairway::drivers {

/// What the instant of a device stamp is. The documents disagree and the readings differ by 3.125 ms; a stamp error
/// shifts the cloud with the disk's turning, so sweeps in opposite directions tell which one is right.
enum class StampReference {
  Rear,   ///< the beam points straight backwards, 180 steps before step 0
  Step0,  ///< the beam points along step 0
};

/// How the latency from a scan's stamp to its arrival is known.
enum class TimeSource {
  Passive,         ///< it is a setting
  TimeAdjustment,  ///< it is measured when the sensor is opened; units that answer on the grid of their mirror turns,
                   ///< as one with firmware P.1.05 did, cannot tell, and the setting stays in force
};

/// How a UTM-30LX is opened, watched and timed. Intensities double the sensor's work: at full rate and more than 95
/// degrees for each step of a cluster they come late or broken, and some firmware then needs its power switched off and
/// on. `problem` refuses them there unless they are forced.
struct ScipOptions {
  std::string serial;                         ///< of the unit that is wanted, as VV and the label tell it; empty is any
  double min_angle_rad = -2.356194490192345;  ///< right end of the scan window, clipped to what PP allows [rad],
                                              ///< in [-pi, pi)
  double max_angle_rad = 2.356194490192345;   ///< left end, likewise, > min_angle
  int cluster = 1;                            ///< neighbouring steps that share their smallest range, 1..99
  int skip_scan = 0;                          ///< mirror turns left out between two scans, 0..9
  bool intensities = false;                   ///< asks for the strengths of the echoes too (ME instead of MD)
  bool force_intensities = false;             ///< even where they may crash the sensor
  StampReference stamp_reference = StampReference::Rear;
  ClockOptions clock;
  TimeSource clock_source = TimeSource::Passive;
  int time_readings = 10;          ///< TM1 round trips at each opening, 1..100; the shortest counts
  double max_round_trip_s = 4e-3;  ///< a longest one that is believed [s], 0.0001..0.1; else the clock stays passive
  double sync_offset_ns = 0.0;     ///< from the rear-pointing beam to the sync pulse, where one is wired [ns],
                                   ///< -25e6..25e6. Not documented; ClockQuality tells by how much it is wrong. A pulse
                                   ///< that comes after the scan's first byte belongs to the next turn: negative

  double drain_silence_s = 0.15;   ///< silence that ends a drain [s], 0.03..2
  double max_drain_s = 0.4;        ///< longest drain: a sensor that streams is never silent [s], up to 10
  double command_timeout_s = 1.0;  ///< wait for a reply [s], 0.14..10; replies come on the grid of the mirror turns
  int command_attempts = 3;        ///< sendings of one command, 1..10; QT is sometimes ignored
  int laser_attempts = 10;         ///< sendings of BM, 1..60: it fails for some seconds after power-up
  double laser_retry_s = 1.0;      ///< pause between them [s], 0.1..10
  double watchdog_margin_s = 0.1;  ///< a scan is missing after 3 scan periods and this [s], 0.01..10
  double self_check_s = 10.0;      ///< longest pause for the sensor's own check inside a stream [s], 0.1..60
  int restarts_before_reopen = 3;  ///< failures in a row until the port is asked to be opened again, 1..100
  double min_backoff_s = 0.5;      ///< pause before opening the sensor again, doubled by each failure [s], 0.01..60
  double max_backoff_s = 10.0;     ///< its bound [s], min_backoff..600

  /// First problem found, worded for the person editing the file; empty when usable.
  std::string problem() const;
};

/// The request for the window in `options`, within what the sensor has. An empty window (options outside the field of
/// view) gives the whole field.
ScanRequest make_request(const ScipOptions& options, const SensorParameters& sensor);

}  // namespace stairway::drivers
