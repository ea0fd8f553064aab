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

std::string Settings::problem() const {
  const std::pair<const char*, std::string> problems[] = {
      {"lcm", lcm.problem()},           {"lidar", lidar.problem()}, {"lidar", usb.problem()},
      {"lidar", sync_input.problem()},  {"disk", disk.problem()},   {"motor", motor.problem()},
      {"encoder", encoder.problem()},   {"mount", mount.problem()}, {"sweep", sweep.problem()},
      {"detector", detector.problem()}, {"input", input.problem()}, {"simulate", simulate.problem()},
      {"record", record.problem()},
  };
  for (const auto& [section, problem] : problems) {
    if (!problem.empty()) return std::string(section) + ": " + problem;
  }
  return {};
}

}  // namespace stairway::config
