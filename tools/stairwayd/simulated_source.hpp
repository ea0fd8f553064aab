// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

#include "config/settings.hpp"
#include "drivers/disk_encoder.hpp"
#include "drivers/disk_motor.hpp"
#include "drivers/utm30lx.hpp"
#include "tools/sim/simulated_robot.hpp"
#include "tools/stairwayd/device_watch.hpp"
#include "tools/stairwayd/measurement_source.hpp"
#include "tools/stairwayd/motor_rest.hpp"

namespace stairway::daemon {

/// The robot that `settings` describe: its scanner on its mount in the scene, a drive and an encoder with the units of
/// the settings, and a disk that reaches its index soon after the self check.
sim::SimulatedRobotOptions simulated_robot_options(const config::Settings& settings);

/// The simulated robot, read through the same drivers as the real one, all in the reader's thread: with a speed of 0,
/// simulated time goes as fast as it is read, and what is measured depends on the settings alone.
class SimulatedSource final : public MeasurementSource {
 public:
  /// @param start_utime_us  the epoch time at which simulated time begins. The daemon gives the time of its start, so
  ///   that simulated messages are as old as real ones would be (at speed 1) and no two runs share their times.
  /// Throws sim::SceneFileError if there is no such scene, std::invalid_argument if it cannot be simulated.
  SimulatedSource(const config::Settings& settings, std::int64_t start_utime_us);

  std::vector<SourceEvent> read(std::chrono::milliseconds timeout) override;
  std::string order(const DiskOrder& order) override;
  void stop() override;
  std::int64_t utime_us(drivers::HostStamp stamp_ns) const override;
  bool waits_for_detector() const override { return speed_ == 0.0; }

  /// For whoever wants to damage it.
  sim::SimulatedRobot& robot() { return robot_; }

 private:
  const std::int64_t start_utime_us_;
  const double speed_;
  const bool has_encoder_;
  sim::SimulatedRobot robot_;
  DeviceWatch watch_;
  std::optional<drivers::DiskEncoder> encoder_;
  std::optional<drivers::Utm30lx> scanner_;
  std::optional<drivers::DiskMotor> motor_;
  MotorRest motor_rest_;
  drivers::HostStamp next_clock_report_ns_ = 0;
};

}  // namespace stairway::daemon
