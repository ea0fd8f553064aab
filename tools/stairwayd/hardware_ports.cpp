// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "drivers/can/socket_can_port.hpp"
#include "drivers/gpio/encoder_lines.hpp"
#include "drivers/host_clock.hpp"
#include "drivers/usb/usb_scanner_opener.hpp"
#include "tools/stairwayd/hardware_source.hpp"

namespace stairway::daemon {

namespace {

using Lines = drivers::PortOpener<drivers::EdgePort>;

std::optional<Lines> sync_line(const config::Settings& settings) {
  if (!settings.sync_input.is_wired()) return std::nullopt;
  drivers::EncoderOptions line;
  line.chip = settings.sync_input.chip;
  line.line_a = settings.sync_input.line;
  line.line_b.clear();
  line.line_index.clear();
  line.bias = drivers::LineBias::PullUp;
  line.access = settings.encoder.access;
  return Lines{[line] { return drivers::open_encoder_lines(line); }};
}

}  // namespace

DevicePorts hardware_ports(const config::Settings& settings) {
  const drivers::SocketCanOptions bus{settings.motor.interface, settings.motor.node_id, settings.motor.host_node_id};
  return {.scanner = drivers::usb_scanner_opener(settings.usb, settings.lidar.serial),
          .motor = {[bus] { return drivers::open_socket_can(bus); }},
          .encoder = {[encoder = settings.encoder] { return drivers::open_encoder_lines(encoder); }},
          .sync = sync_line(settings),
          .now_ns = drivers::monotonic_now_ns};
}

}  // namespace stairway::daemon
