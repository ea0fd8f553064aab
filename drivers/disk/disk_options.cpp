// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "drivers/disk/disk_options.hpp"

#include <cmath>

namespace stairway::drivers {
namespace {

bool is_within(double value, double min, double max) { return value >= min && value <= max; }

}  // namespace

const char* to_string(DiskMode mode) {
  switch (mode) {
    case DiskMode::Continuous:
      return "continuous sweeps";
    case DiskMode::SingleSweep:
      return "a single sweep";
    case DiskMode::Idle:
      return "idle";
  }
  return "unknown";
}

std::string DiskOptions::problem() const {
  if (!is_within(std::abs(period_s), 1.0, 600.0)) return "period must lie within 1 .. 600 s or -600 .. -1 s";
  if (!is_within(drive_zero_rad, -std::numbers::pi, std::numbers::pi))
    return "drive_zero must lie within -180 .. 180 degrees";
  if (!is_within(idle_after_s, 0.0, 86400.0)) return "idle_after must lie within 0 .. 86400 s";
  if (!is_within(check_speed_rad_s, 0.001, 10.0)) return "check_speed must lie within 0.001 .. 10 rad/s";
  if (!is_within(check_window_s, 0.1, 60.0)) return "check_window must lie within 0.1 .. 60 s";
  if (!is_within(settle_s, 0.0, 60.0)) return "settle must lie within 0 .. 60 s";
  if (!is_within(check_tolerance, 0.01, 0.9)) return "check_tolerance must lie within 0.01 .. 0.9";
  if (!is_within(slip_tolerance, 0.01, 0.9)) return "slip_tolerance must lie within 0.01 .. 0.9";
  if (!is_within(standing_speed_rad_s, 0.0001, 1.0)) return "standing_speed must lie within 0.0001 .. 1 rad/s";
  if (!is_within(retry_s, 1.0, 3600.0)) return "retry must lie within 1 .. 3600 s";
  return {};
}

}  // namespace stairway::drivers
