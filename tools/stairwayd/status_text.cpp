// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "tools/stairwayd/status_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string_view>

namespace stairway::daemon {
namespace {

constexpr double kOldData_s = 2.0;
constexpr std::array<std::string_view, 4> kQueueDrops{"measurements-dropped", "unrecorded-messages", "unseen-sweeps",
                                                      "unsent-messages"};

// Only what has data, or troubles: the state says what the others wait for.
std::string device_text(const ipc::DeviceHealth& device) {
  std::string text;
  if (device.data_age_s >= 0.0) text += fmt::format(" {:.0f}/s", device.rate_hz);
  if (device.data_age_s > kOldData_s) text += fmt::format(" silent {:.0f} s", device.data_age_s);
  if (device.troubles > 0) text += fmt::format(" {} troubles", device.troubles);
  return text.empty() ? text : ", " + device.name + text;
}

std::string result_text(const ipc::ResultHealth& result) {
  if (result.stairways < 0) return ", no answer yet";
  std::string text = fmt::format(", {} stairways in the last answer", result.stairways);
  if (result.stairways == 0 && result.stairway_age_s >= 0.0)
    text += fmt::format(", one {:.0f} s ago", result.stairway_age_s);
  return text;
}

}  // namespace

std::string status_text(const ipc::HealthMessage& health) {
  std::string text = health.state;
  text += fmt::format(" | sweep {} {:.0f} %", health.sweep, 100.0 * health.sweep_progress);
  for (const ipc::DeviceHealth& device : health.devices) text += device_text(device);
  for (const auto& [name, count] : health.drops) {
    if (std::ranges::find(kQueueDrops, name) != kQueueDrops.end()) text += fmt::format(", {} {}", name, count);
  }
  text += result_text(health.result);
  // A line end would begin another message to systemd.
  std::ranges::replace(text, '\n', ' ');
  return text;
}

}  // namespace stairway::daemon
