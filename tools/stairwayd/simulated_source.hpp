// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <optional>

#include "config/settings.hpp"
#include "drivers/utm30lx.hpp"
#include "tools/sim/simulated_robot.hpp"
#include "tools/stairwayd/measurement_source.hpp"

namespace stairway::daemon {

/// The simulated robot, read through the real scanner driver.
///
/// The scanner is opened first; when it streams, the disk starts from rest at its index. With a speed of 0, simulated
/// time goes as fast as it is read, and what is measured depends on the settings alone.
class SimulatedSource final : public MeasurementSource {
 public:
  /// @param start_utime_us  the epoch time at which simulated time begins. The daemon gives the time of its start, so
  ///   that simulated messages are as old as real ones would be (at speed 1) and no two runs share their times.
  /// Throws sim::SceneFileError if there is no such scene, std::invalid_argument if it cannot be simulated.
  SimulatedSource(const config::Settings& settings, std::int64_t start_utime_us);

  std::vector<SourceEvent> read(std::chrono::milliseconds timeout) override;
  void stop() override;
  std::int64_t utime_us(drivers::HostStamp stamp_ns) const override;

 private:
  std::int64_t start_utime_us_;
  double speed_;
  double disk_speed_rad_s_;
  sim::SimulatedRobot robot_;
  std::unique_ptr<drivers::AnglePort> encoder_;
  std::optional<drivers::Utm30lx> scanner_;
};

}  // namespace stairway::daemon
