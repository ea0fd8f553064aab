// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <numbers>
#include <string>

namespace stairway::drivers {

/// Who says at which angle the disk stands.
enum class AngleSource : std::uint8_t {
  Encoder,  ///< the disk's own encoder, with an index that finds the zero
  Drive,    ///< the motor drive's position, for a robot without an encoder; its zero is only as good as a setting
};

/// What the disk is there for at the moment.
enum class DiskMode : std::uint8_t {
  Continuous,   ///< turns and turns
  SingleSweep,  ///< turns until one sweep of a whole turn is complete, then rests
  Idle,         ///< rests, with the drive switched off, until a command
};
const char* to_string(DiskMode mode);

/// How the disk is turned, and what its supervision tolerates.
struct DiskOptions {
  double period_s = 35.0;                ///< one turn [s], negative turns clockwise seen from above; 1..600 or -600..-1
  DiskMode mode = DiskMode::Continuous;  ///< after the start; commands change it
  AngleSource angle_source = AngleSource::Encoder;
  double drive_zero_rad = 0.0;  ///< the drive's angle where the disk's is 0 [rad], in [-pi, pi]; for AngleSource::Drive
  double idle_after_s = 60.0;   ///< how long the disk goes on turning without scans or without encoder [s], 0..86400

  double check_speed_rad_s = std::numbers::pi / 30.0;  ///< of the self check before the first turn [rad/s], 0.001..10
  double check_window_s = 1.0;                         ///< over which speeds are compared [s], 0.1..60
  double settle_s = 0.3;                               ///< a speed is left alone after its ramp [s], 0..60
  double check_tolerance = 0.2;                        ///< by which speeds may differ in the self check, 0.01..0.9
  double slip_tolerance = 0.1;                         ///< likewise while the disk turns, 0.01..0.9
  double standing_speed_rad_s =
      std::numbers::pi / 180.0;  ///< a disk that should stand moves slower than this [rad/s], 0.0001..1
  double retry_s = 30.0;         ///< pause between a failed self check and the next one [s], 1..3600

  /// The speed that `period_s` asks for, positive counter-clockwise seen from above [rad/s].
  double speed_rad_s() const { return 2.0 * std::numbers::pi / period_s; }

  /// First problem found, worded for the person editing the file; empty when usable.
  std::string problem() const;
};

}  // namespace stairway::drivers
