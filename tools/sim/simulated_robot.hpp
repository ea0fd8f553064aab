// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <numbers>
#include <string>

#include "drivers/ports/angle_port.hpp"
#include "drivers/ports/byte_port.hpp"
#include "drivers/types.hpp"
#include "scan_assembly/frames.hpp"
#include "tools/sim/fake_utm30lx.hpp"
#include "tools/sim/scanner_model.hpp"
#include "tools/sim/scene.hpp"

namespace stairway::sim {

struct SimulatedRobotOptions {
  scan::MountOptions mount;  ///< where the scanner really is
  ScannerOptions scanner;
  FakeUtm30lxOptions sensor;                              ///< its start_ns is where simulated host time begins
  double disk_speed_rad_s = 2 * std::numbers::pi / 35.0;  ///< at the start; negative turns clockwise
  double start_angle_rad = 0.0;                           ///< of the disk; the encoder's index is at 0
  int encoder_counts_per_turn = 4096;
  double speed_factor = 0.0;  ///< simulated seconds per real second; 0 is as fast as the ports are read
  std::uint64_t seed = 1;

  /// First problem found; empty when usable.
  std::string problem() const;
};

/// A whole robot in simulated time: the scanner and the disk's encoder as ports, fed by one scene and one clock.
///
/// With a speed factor, simulated time follows the machine's clock, and readers wait. With factor 0 it jumps to what
/// the scanner's reader waits for, be it bytes or the end of the wait; but while the encoder is open, not more than 0.1
/// s beyond what its reader has seen, so that neither floods the other. Without an open scanner, the encoder's reader
/// moves time. What is measured depends on the options and on the commands' times, not on the threads.
///
/// Thread-safe. Ports may outlive the robot.
class SimulatedRobot {
 public:
  /// Throws std::invalid_argument with problem().
  SimulatedRobot(const Scene& scene, const SimulatedRobotOptions& options);

  /// The scanner's cable. One port at a time; a second one shares the sensor with the first.
  std::unique_ptr<drivers::BytePort> open_scanner();
  std::unique_ptr<drivers::AnglePort> open_encoder();

  /// Simulated host time, the line of all stamps [ns].
  drivers::HostStamp now_ns() const;
  /// From now on.
  void set_disk_speed(double speed_rad_s);
  double disk_speed_rad_s() const;
  /// True angle now, not wrapped [rad].
  double disk_angle_rad() const;

 private:
  class World;
  class ScannerPort;
  class EncoderPort;
  std::shared_ptr<World> world_;
};

}  // namespace stairway::sim
