// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "drivers/scip/scip_options.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "drivers/option_range.hpp"

namespace stairway::drivers {
namespace {

constexpr double kPi = std::numbers::pi;

bool overloads_sensor(const ScipOptions& options) {
  constexpr double kFieldOfView_rad = 1.5 * kPi;
  constexpr double kBearable_rad = 95.5 / 180.0 * kPi;  // half a degree for the rounding of steps
  const double window_rad = std::min(options.max_angle_rad - options.min_angle_rad, kFieldOfView_rad);
  return options.skip_scan == 0 && window_rad > kBearable_rad * options.cluster;
}

}  // namespace

std::string ScipOptions::problem() const {
  const OptionRange ranges[] = {
      {"cluster", static_cast<double>(cluster), 1.0, 99.0},
      {"skip_scan", static_cast<double>(skip_scan), 0.0, 9.0},
      {"time_readings", static_cast<double>(time_readings), 1.0, 100.0},
      {"max_round_trip_s", max_round_trip_s, 1e-4, 0.1},
      {"sync_offset_ns", sync_offset_ns, -25e6, 25e6},
      {"drain_silence_s", drain_silence_s, 0.03, 2.0},
      {"max_drain_s", max_drain_s, drain_silence_s, 10.0},
      {"command_timeout_s", command_timeout_s, 0.14, 10.0},
      {"command_attempts", static_cast<double>(command_attempts), 1.0, 10.0},
      {"laser_attempts", static_cast<double>(laser_attempts), 1.0, 60.0},
      {"laser_retry_s", laser_retry_s, 0.1, 10.0},
      {"watchdog_margin_s", watchdog_margin_s, 0.01, 10.0},
      {"self_check_s", self_check_s, 0.1, 60.0},
      {"restarts_before_reopen", static_cast<double>(restarts_before_reopen), 1.0, 100.0},
      {"min_backoff_s", min_backoff_s, 0.01, 60.0},
      {"max_backoff_s", max_backoff_s, min_backoff_s, 600.0},
  };
  if (!(min_angle_rad >= -kPi && min_angle_rad < max_angle_rad && max_angle_rad <= kPi)) {
    return "the scan window needs -180 <= min_angle < max_angle <= 180 degrees";
  }
  if (auto problem = range_problem(ranges); !problem.empty()) return problem;
  if (intensities && !force_intensities && overloads_sensor(*this)) {
    return "intensities overload the sensor at this window: use cluster 3, skip_scan 1, at most 95 degrees, or "
           "force_intensities";
  }
  return clock.problem();
}

ScanRequest make_request(const ScipOptions& options, const SensorParameters& sensor) {
  const double steps_per_rad = sensor.steps_per_turn / (2.0 * kPi);
  const auto step_at = [&](double angle_rad) {
    const int step = sensor.front_step + static_cast<int>(std::lround(angle_rad * steps_per_rad));
    return std::clamp(step, sensor.first_step, sensor.last_step);
  };
  ScanRequest request;
  request.first_step = step_at(options.min_angle_rad);
  request.last_step = step_at(options.max_angle_rad);
  if (request.first_step >= request.last_step) {
    request.first_step = sensor.first_step;
    request.last_step = sensor.last_step;
  }
  if (options.intensities) request.symbol = "ME";
  request.cluster = options.cluster;
  request.skip_scan = options.skip_scan;
  return request;
}

}  // namespace stairway::drivers
