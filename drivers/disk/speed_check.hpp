// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "drivers/disk/disk_events.hpp"

namespace stairway::drivers {

/// The settings that turn the devices' units into the disk's; as they are, for proposals of what they should be.
struct DiskUnits {
  double counts_per_turn = 1.0;                ///< motor.counts_per_turn
  double velocity_units_per_turn_per_s = 1.0;  ///< motor.velocity_units_per_turn_per_s
  bool is_drive_reversed = false;              ///< motor.reverse
  int encoder_counts_per_turn = 1;             ///< encoder.counts_per_turn
  bool is_encoder_reversed = false;            ///< encoder.reverse
  double acceleration_rad_s2 = 1.0;            ///< the weaker of the drive's ramps, > 0
};

/// Mean speeds of the disk over the same stretch of time, positive counter-clockwise [rad/s]; empty when nothing was
/// told.
struct DiskSpeeds {
  double wanted_rad_s = 0.0;
  std::optional<double> drive_speed_rad_s;     ///< as the drive says it (606C)
  std::optional<double> drive_position_rad_s;  ///< by the drive's positions (6064)
  std::optional<double> encoder_rad_s;
  bool has_encoder = true;  ///< false on a robot without one
};

struct SpeedLimits {
  double tolerance = 0.2;              ///< share by which two speeds may differ
  double standing_speed_rad_s = 0.02;  ///< slower counts as standing while no speed is wanted
  bool is_check = true;                ///< units are in doubt: a difference is told as Mismatch, else as Slip
};

/// What the speeds say against each other, first the gravest; empty when they fit. The encoder is taken for right
/// where one of three must be wrong.
std::optional<DiskTroubleEvent> compare_speeds(const DiskSpeeds& speeds, const SpeedLimits& limits,
                                               const DiskUnits& units);

}  // namespace stairway::drivers
