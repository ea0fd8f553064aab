// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "drivers/canopen/cia402.hpp"

#include <algorithm>
#include <iterator>

namespace stairway::drivers {
namespace {

struct Pattern {
  std::uint16_t mask;
  std::uint16_t value;
  DriveState state;
};

constexpr Pattern kPatterns[] = {
    {0x4f, 0x00, DriveState::NotReady},      {0x4f, 0x40, DriveState::SwitchOnDisabled},
    {0x6f, 0x21, DriveState::Ready},         {0x6f, 0x23, DriveState::SwitchedOn},
    {0x6f, 0x27, DriveState::Enabled},       {0x6f, 0x07, DriveState::QuickStop},
    {0x4f, 0x0f, DriveState::FaultReaction}, {0x4f, 0x08, DriveState::Fault},
};

struct Step {
  DriveState state;
  std::uint16_t command;
};

constexpr Step kStepsToEnable[] = {
    {DriveState::SwitchOnDisabled, controlword::kShutdown}, {DriveState::Ready, controlword::kSwitchOn},
    {DriveState::SwitchedOn, controlword::kEnable},         {DriveState::Enabled, controlword::kEnable},
    {DriveState::QuickStop, controlword::kDisableVoltage},
};

}  // namespace

const char* to_string(DriveState state) {
  switch (state) {
    case DriveState::NotReady:
      return "not ready to switch on";
    case DriveState::SwitchOnDisabled:
      return "switch-on disabled";
    case DriveState::Ready:
      return "ready to switch on";
    case DriveState::SwitchedOn:
      return "switched on";
    case DriveState::Enabled:
      return "operation enabled";
    case DriveState::QuickStop:
      return "quick stop active";
    case DriveState::FaultReaction:
      return "fault reaction active";
    case DriveState::Fault:
      return "fault";
    case DriveState::Unknown:
      break;
  }
  return "in no known state";
}

DriveState decode_statusword(std::uint16_t word) {
  const auto* found =
      std::ranges::find_if(kPatterns, [&](const Pattern& pattern) { return (word & pattern.mask) == pattern.value; });
  return found == std::end(kPatterns) ? DriveState::Unknown : found->state;
}

std::optional<std::uint16_t> command_to_enable(DriveState state) {
  const auto* found = std::ranges::find(kStepsToEnable, state, &Step::state);
  return found == std::end(kStepsToEnable) ? std::nullopt : std::optional(found->command);
}

}  // namespace stairway::drivers
