// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "drivers/canopen/motor_events.hpp"

namespace stairway::drivers {

const char* to_string(MotorState state) {
  switch (state) {
    case MotorState::Searching:
      return "searching";
    case MotorState::Configuring:
      return "configuring";
    case MotorState::Enabling:
      return "enabling";
    case MotorState::Running:
      return "running";
    case MotorState::Faulted:
      return "faulted";
    case MotorState::Backoff:
      return "backoff";
    case MotorState::Stopping:
      return "stopping";
    case MotorState::Stopped:
      return "stopped";
  }
  return "unknown";
}

const char* to_string(MotorTrouble trouble) {
  switch (trouble) {
    case MotorTrouble::Disconnected:
      return "disconnected";
    case MotorTrouble::Bus:
      return "CAN bus";
    case MotorTrouble::HeartbeatLost:
      return "drive silent";
    case MotorTrouble::Rebooted:
      return "drive restarted";
    case MotorTrouble::SdoAbort:
      return "object refused";
    case MotorTrouble::SdoTimeout:
      return "object not answered";
    case MotorTrouble::Unexpected:
      return "unexpected message";
    case MotorTrouble::Emergency:
      return "drive error message";
    case MotorTrouble::Fault:
      return "drive fault";
    case MotorTrouble::SwitchedOff:
      return "drive switched itself off";
    case MotorTrouble::StateTimeout:
      return "drive does not follow";
    case MotorTrouble::NotReached:
      return "speed not reached";
    case MotorTrouble::Unsuitable:
      return "drive unsuitable";
  }
  return "unknown";
}

}  // namespace stairway::drivers
