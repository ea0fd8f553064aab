// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

namespace stairway::drivers {

/// State of a CiA 402 power drive as its statusword (object 6041) tells it.
enum class DriveState : std::uint8_t {
  NotReady,          ///< starts up
  SwitchOnDisabled,  ///< off; also with safe torque off
  Ready,             ///< ready to switch on
  SwitchedOn,
  Enabled,  ///< operation enabled: the motor follows the target
  QuickStop,
  FaultReaction,  ///< brakes because of a fault
  Fault,          ///< off until it is reset
  Unknown,        ///< bits that no state has
};
const char* to_string(DriveState state);

namespace statusword {
inline constexpr std::uint16_t kVoltage = 1U << 4;
inline constexpr std::uint16_t kRemote = 1U << 9;
inline constexpr std::uint16_t kTargetReached = 1U << 10;
inline constexpr std::uint16_t kStandstill = 1U << 12;  ///< in profile velocity mode
}  // namespace statusword

/// Commands of object 6040.
namespace controlword {
inline constexpr std::uint16_t kDisableVoltage = 0x0000;
inline constexpr std::uint16_t kQuickStop = 0x0002;
inline constexpr std::uint16_t kShutdown = 0x0006;
inline constexpr std::uint16_t kSwitchOn = 0x0007;
inline constexpr std::uint16_t kEnable = 0x000f;
inline constexpr std::uint16_t kFaultReset = 0x0080;
}  // namespace controlword

DriveState decode_statusword(std::uint16_t word);

inline bool is_fault(DriveState state) { return state == DriveState::Fault || state == DriveState::FaultReaction; }
/// No current in the motor.
inline bool is_off(DriveState state) {
  return state == DriveState::NotReady || state == DriveState::SwitchOnDisabled || state == DriveState::Ready ||
         state == DriveState::Fault;
}

/// The command that brings a drive one step nearer to operation enabled; empty where one must wait (not ready, fault
/// reaction) or where a fault has to be dealt with first.
std::optional<std::uint16_t> command_to_enable(DriveState state);

}  // namespace stairway::drivers
