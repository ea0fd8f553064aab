// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "drivers/scip/scan_conversion.hpp"

#include <cmath>
#include <limits>
#include <numbers>

namespace stairway::drivers {

BeamStatus classify_range(std::uint32_t range_mm, const SensorParameters& sensor) {
  if (range_mm > static_cast<std::uint32_t>(sensor.max_range_mm)) return BeamStatus::NoReturn;
  if (range_mm >= static_cast<std::uint32_t>(sensor.min_range_mm)) return BeamStatus::Ok;
  switch (range_mm) {
    case 1:
      return BeamStatus::NoReturn;
    case 2:
    case 4:
      return BeamStatus::TooNear;
    case 3:
      return BeamStatus::Disturbed;
    default:
      return BeamStatus::Invalid;
  }
}

LaserScan to_laser_scan(const RawScan& raw, const ScanRequest& request, const SensorParameters& sensor,
                        std::int64_t device_stamp_ms, const ScanTime& time, StampReference reference) {
  const int cluster = request.effective_cluster();
  const double step_rad = 2.0 * std::numbers::pi / sensor.steps_per_turn;
  const double step_ns = time.period_ns / (request.skip_scan + 1) / sensor.steps_per_turn;
  const double first_step = request.first_step + 0.5 * (cluster - 1);
  const double stamped_step = reference == StampReference::Rear ? sensor.front_step - 0.5 * sensor.steps_per_turn : 0.0;

  LaserScan scan;
  scan.sequence = time.sequence;
  scan.device_stamp_ms = device_stamp_ms;
  scan.first_beam_stamp_ns = time.stamp_ns + std::llround((first_step - stamped_step) * step_ns);
  scan.beam_interval_ns = cluster * step_ns;
  scan.first_angle_rad = (first_step - sensor.front_step) * step_rad;
  scan.angle_increment_rad = cluster * step_rad;
  scan.ranges_m.reserve(raw.ranges_mm.size());
  scan.statuses.reserve(raw.ranges_mm.size());
  scan.intensities = raw.intensities;
  for (const std::uint32_t range_mm : raw.ranges_mm) {
    const BeamStatus status = classify_range(range_mm, sensor);
    scan.statuses.push_back(status);
    scan.ranges_m.push_back(status == BeamStatus::Ok ? static_cast<float>(range_mm) * 1e-3F
                                                     : std::numeric_limits<float>::quiet_NaN());
  }
  return scan;
}

}  // namespace stairway::drivers
