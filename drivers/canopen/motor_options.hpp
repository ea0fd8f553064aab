// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <numbers>
#include <string>

namespace stairway::drivers {

/// What the drive does on its own when it no longer hears this host (object 6007).
enum class ConnectionLoss : std::uint8_t { Nothing, Fault, DisableVoltage, QuickStop };

/// How the drive does a quick stop before it switches itself off (object 605A).
enum class QuickStopRamp : std::uint8_t { None, Deceleration, QuickStopDeceleration };

/// The disk's CiA 402 drive, its units and its limits. A "turn" is one of the disk, gears included.
struct MotorOptions {
  std::string interface = "can0";  ///< of the bus, as `ip link` shows it
  int node_id = 1;                 ///< the drive's, 1..127
  int host_node_id = 127;          ///< this host's, for its heartbeat, 1..127 and not the drive's

  double counts_per_turn = 204800.0;                   ///< of the drive's position (6064), > 0: 4096 and a gear of 50
  double velocity_units_per_turn_per_s = 204800.0;     ///< of its speeds (60FF, 606C), > 0
  double acceleration_units_per_turn_per_s2 = 204800;  ///< of its ramps (6083, 6084, 6085), > 0
  bool reverse = false;                                ///< the drive counts up while the disk turns clockwise
  double acceleration_rad_s2 = std::numbers::pi / 3;   ///< of the disk, 0.001..1000
  double deceleration_rad_s2 = std::numbers::pi / 3;   ///< of the disk, 0.001..1000
  double quick_stop_deceleration_rad_s2 = std::numbers::pi / 0.6;  ///< of the disk, 0.001..1000
  double standstill_speed_rad_s = std::numbers::pi / 600;          ///< the disk stands below this, 0.0001..1
  QuickStopRamp quick_stop_ramp = QuickStopRamp::QuickStopDeceleration;
  ConnectionLoss connection_loss = ConnectionLoss::QuickStop;

  double heartbeat_s = 0.1;            ///< period of the drive's heartbeat, 0.02..10; it is lost after 2.5 of them
  double host_heartbeat_s = 0.5;       ///< the drive brakes when it misses this host's for so long, 0.1..10
  double sync_rate_hz = 100.0;         ///< of angle and speed from the drive, 10..500
  double sdo_timeout_s = 0.2;          ///< wait for an object, 0.05..10
  double state_timeout_s = 5.0;        ///< wait for a step of the drive's states or modes, 0.2..60
  double boot_timeout_s = 3.0;         ///< wait for the drive after its reset, 0.5..60
  double reach_timeout_s = 3.0;        ///< a wanted speed is reached after its ramp and this, 0.1..600
  double stop_timeout_s = 3.0;         ///< wait for standstill when stopping, 0.1..60
  int max_fault_resets = 3;            ///< within the window; then its end is waited for, 0..100
  double fault_reset_window_s = 60.0;  ///< 1..3600
  bool reset_on_start = true;          ///< reset the drive's communication before it is set up
  double min_backoff_s = 0.5;          ///< pause before it is set up again, doubled by each failure, 0.01..60
  double max_backoff_s = 10.0;         ///< its bound, min_backoff..600

  /// First problem found, worded for the person editing the file; empty when usable.
  std::string problem() const;
};

/// Between the disk (radians, counter-clockwise from above) and the drive (its own units and direction).
class MotorUnits {
 public:
  explicit MotorUnits(const MotorOptions& options);

  /// Target for object 60FF; limited to what 32 bits hold, NaN gives 0.
  std::int32_t velocity_units(double speed_rad_s) const;
  double speed_rad_s(std::int32_t velocity_units) const { return velocity_units * speed_of_unit_; }
  double angle_rad(std::int64_t counts) const { return static_cast<double>(counts) * angle_of_count_; }
  /// Ramp for objects 6083 to 6085, at least 1.
  std::uint32_t acceleration_units(double acceleration_rad_s2) const;

 private:
  double speed_of_unit_;
  double angle_of_count_;
  double acceleration_of_unit_;
};

/// Why the drive cannot turn the disk at this speed [rad/s]: it is less than half of the drive's unit of speed. Worded
/// for the person who asks for the speed; empty when it can.
std::string speed_problem(const MotorOptions& options, double speed_rad_s);

/// By how much the drive's whole units miss this speed [rad/s], for a person, when it is more than 5 %; else empty.
/// @pre  speed_problem() is empty.
std::string speed_warning(const MotorOptions& options, double speed_rad_s);

}  // namespace stairway::drivers
