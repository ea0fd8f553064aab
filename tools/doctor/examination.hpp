// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "drivers/encoder/encoder_options.hpp"
#include "drivers/ports/byte_port.hpp"
#include "drivers/ports/can_port.hpp"
#include "drivers/ports/edge_port.hpp"
#include "drivers/ports/port_opener.hpp"
#include "drivers/scip/scip_options.hpp"
#include "ipc/channels.hpp"
#include "tools/doctor/check.hpp"
#include "tools/doctor/machine.hpp"
#include "tools/doctor/scanner.hpp"

namespace stairway::doctor {

/// What the settings say the robot is made of.
struct Robot {
  WantedScanner scanner;
  drivers::ScipOptions lidar;
  std::string can_interface = "can0";
  int drive_node = 1;
  std::optional<drivers::EncoderOptions> encoder;  ///< empty where the drive tells the angle
  double disk_speed_rad_s = 0.0;                   ///< at which it will turn
  ipc::BusOptions lcm;
};

/// How its devices are opened; one that is left out is not opened.
struct Ports {
  std::optional<drivers::PortOpener<drivers::BytePort>> scanner;
  drivers::PortOpener<drivers::CanPort>::Open can;
  drivers::PortOpener<drivers::EdgePort>::Open encoder;
  std::function<drivers::HostStamp()> now;  ///< on the time line of their stamps
};

/// How long to wait for what.
struct Patience {
  std::chrono::nanoseconds scanner = std::chrono::seconds(15);  ///< it needs 10 s after power-up
  std::chrono::nanoseconds drive = std::chrono::seconds(2);
  std::chrono::nanoseconds encoder = std::chrono::seconds(1);
  std::chrono::milliseconds daemon = std::chrono::milliseconds(2500);  ///< it tells its health once a second
};

/// Looks at everything. A running daemon keeps its scanner and its encoder unless `is_probing`, which also lets the
/// drive be asked instead of listened to.
std::vector<Check> examine(const Machine& machine, const Robot& robot, const Ports& ports, const Patience& patience,
                           bool is_probing);

}  // namespace stairway::doctor
