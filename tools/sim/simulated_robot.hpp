// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>

#include "drivers/ports/byte_port.hpp"
#include "drivers/ports/can_port.hpp"
#include "drivers/ports/edge_port.hpp"
#include "drivers/ports/port_opener.hpp"
#include "drivers/types.hpp"
#include "scan_assembly/frames.hpp"
#include "tools/sim/disk_motion.hpp"
#include "tools/sim/fake_can_bus.hpp"
#include "tools/sim/fake_drive.hpp"
#include "tools/sim/fake_encoder_lines.hpp"
#include "tools/sim/fake_utm30lx.hpp"
#include "tools/sim/scanner_model.hpp"
#include "tools/sim/scene.hpp"

namespace stairway::sim {

struct SimulatedRobotOptions {
  scan::MountOptions mount;  ///< where the scanner really is
  ScannerOptions scanner;
  FakeUtm30lxOptions sensor;  ///< its start_ns is where simulated host time begins
  FakeDriveOptions drive;     ///< its start_ns is a second before the sensor's
  int encoder_counts_per_turn = 4096;
  double start_angle_rad = 0.0;  ///< of the disk, which stands; the encoder's index is at 0
  double speed_factor = 0.0;     ///< simulated seconds per real second; 0 is as fast as the ports are read
  std::uint64_t seed = 1;

  /// First problem found; empty when usable.
  std::string problem() const;
};

/// A whole robot in simulated time: scanner, drive and encoder behind ports that speak their protocols, fed by one
/// scene, one disk and one clock. The drive turns the disk.
///
/// With a speed factor, simulated time follows the machine's clock, and readers wait. With factor 0 it jumps to what a
/// reader waits for, be it data or the end of the wait; but not more than 0.1 s beyond what the readers of other open
/// ports have seen, if those are other threads, so that none floods another. What is measured depends on the options
/// and on the commands' times, not on the threads.
///
/// Thread-safe. Ports may outlive the robot.
class SimulatedRobot {
 public:
  enum class Cable : std::uint8_t { Scanner, Motor, Encoder };

  /// What the robot is made of, for whoever wants to damage it.
  struct Parts {
    FakeUtm30lx& scanner;
    FakeDrive& drive;
    FakeCanBus& bus;
    FakeEncoderLines& encoder;
    DiskMotion& disk;
    drivers::HostStamp now_ns;
  };

  /// Throws std::invalid_argument with problem().
  SimulatedRobot(const Scene& scene, const SimulatedRobotOptions& options);

  /// The devices' cables, one port of each at a time. An opener's wait passes simulated time; it ends early when a
  /// cable is plugged in.
  drivers::PortOpener<drivers::BytePort> scanner();
  drivers::PortOpener<drivers::CanPort> motor();
  drivers::PortOpener<drivers::EdgePort> encoder();

  /// Ports on a cable that is pulled out are closed, and new ones cannot be opened. The device itself goes on.
  void plug(Cable cable, bool is_plugged);
  /// Calls back with all parts as they are now.
  void tamper(const std::function<void(const Parts&)>& change);

  /// Simulated host time, the line of all stamps [ns].
  drivers::HostStamp now_ns() const;
  double disk_speed_rad_s() const;
  /// True angle now, not wrapped [rad].
  double disk_angle_rad() const;

 private:
  class World;
  class ScannerPort;
  class MotorPort;
  class EncoderPort;
  std::shared_ptr<World> world_;
};

}  // namespace stairway::sim
