// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "config/settings.hpp"

#include <utility>

namespace stairway::config {

std::string InputOptions::problem() const {
  if (gravity && !(gravity->norm() > 0.0)) return "gravity must not be zero";
  return {};
}

std::string SimulationOptions::problem() const {
  if (scene.empty()) return "scene must name a scene or a scene file";
  return {};
}

ipc::BusOptions SourceOptions::bus(const ipc::BusOptions& own) const {
  ipc::BusOptions bus = own;
  if (!lcm_url.empty()) bus.url = lcm_url;
  if (!lcm_channel_prefix.empty()) bus.channel_prefix = lcm_channel_prefix;
  return bus;
}

namespace {

std::string source_problem(const SourceOptions& source, const ipc::BusOptions& own) {
  if (source.kind != SourceKind::Lcm) return {};
  const ipc::BusOptions bus = source.bus(own);
  const bool is_network = bus.url.starts_with("udpm://") || bus.url.starts_with("tcpq://");
  if (!is_network) return "kind = \"lcm\" takes a URL that starts with udpm:// or tcpq://; --replay plays a file";
  return bus.problem();
}

}  // namespace

std::string Settings::problem() const {
  const std::pair<const char*, std::string> problems[] = {
      {"lcm", lcm.problem()},
      {"lidar", lidar.problem()},
      {"lidar", usb.problem()},
      {"lidar", sync_input.problem()},
      {"disk", disk.problem()},
      {"motor", motor.problem()},
      {"encoder", encoder.problem()},
      {"mount", mount.problem()},
      {"sweep", sweep.problem()},
      {"detector", detector.problem()},
      {"input", input.problem()},
      {"simulate", simulate.problem()},
      {"record", record.problem()},
      {"source", source_problem(source, lcm)},
      {"motor", drivers::speed_problem(motor, disk.speed_rad_s())},
      {"motor", drivers::speed_problem(motor, disk.check_speed_rad_s)},
  };
  for (const auto& [section, problem] : problems) {
    if (!problem.empty()) return std::string(section) + ": " + problem;
  }
  return {};
}

}  // namespace stairway::config
