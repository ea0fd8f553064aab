// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <variant>

#include "drivers/types.hpp"

namespace stairway::drivers {

enum class MotorState : std::uint8_t {
  Searching,    ///< no drive is heard, or the bus is down
  Configuring,  ///< NMT, SDO, mapping
  Enabling,     ///< on the way through CiA 402
  Running,      ///< operation enabled; follows the wanted speed, which may be 0
  Faulted,      ///< the drive reports a fault; waits for its reset
  Backoff,      ///< waiting before trying again
  Stopping,     ///< the stop sequence runs
  Stopped,      ///< it has ended
};
const char* to_string(MotorState state);

/// What can go wrong with the drive; each is counted.
enum class MotorTrouble : std::uint8_t {
  Disconnected,   ///< the interface is missing or was removed
  Bus,            ///< bus-off, link down, nobody acknowledges, frames lost or stuck
  HeartbeatLost,  ///< the drive fell silent
  Rebooted,       ///< a boot-up message: its settings are gone
  SdoAbort,       ///< an object was refused
  SdoTimeout,     ///< an object was not answered
  Unexpected,     ///< an SDO answer without a question (another master?), a PDO that is too short, a bad frame
  Emergency,      ///< EMCY
  Fault,          ///< statusword fault
  SwitchedOff,    ///< the drive left operation by itself: quick stop input, safe torque off, no voltage
  StateTimeout,   ///< a step of CiA 402 was not followed
  NotReached,     ///< the wanted speed was not reached in time
  Unsuitable,     ///< not a CiA 402 drive, or without profile velocity
};
inline constexpr std::size_t kMotorTroubles = 13;
const char* to_string(MotorTrouble trouble);

/// Monotonic counts since the session began.
struct MotorCounters {
  std::uint64_t feedbacks = 0;
  std::uint64_t dropped_frames = 0;  ///< to be sent, but not taken in time
  std::array<std::uint64_t, kMotorTroubles> troubles{};

  std::uint64_t count(MotorTrouble trouble) const { return troubles[static_cast<std::size_t>(trouble)]; }
};

/// What the drive says about the disk: at every SYNC, in units of the disk.
struct DriveFeedback {
  HostStamp stamp_ns = 0;    ///< [ns]
  double angle_rad = 0.0;    ///< not wrapped, from the drive's own zero; goes on through counter overflow [rad]
  double speed_rad_s = 0.0;  ///< positive counter-clockwise from above [rad/s]
  bool is_moving = false;    ///< faster than `standstill_speed_rad_s`, and the drive does not report standstill
};

/// What the drive said about itself when it was set up.
struct DriveInfo {
  std::string name;  ///< object 1008; empty where there is none
  std::uint32_t vendor = 0;
  std::uint32_t product = 0;
  std::uint32_t revision = 0;
  std::uint32_t serial = 0;
};

struct MotorStateEvent {
  MotorState state = MotorState::Searching;
};

struct MotorTroubleEvent {
  MotorTrouble trouble = MotorTrouble::Bus;
  std::string detail;  ///< for a person: what came, what was asked, what to do
};

using MotorEvent = std::variant<DriveFeedback, DriveInfo, MotorStateEvent, MotorTroubleEvent>;

}  // namespace stairway::drivers
