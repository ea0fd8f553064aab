// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "drivers/disk/disk_events.hpp"

namespace stairway::drivers {

const char* to_string(DiskState state) {
  switch (state) {
    case DiskState::Resting:
      return "at rest";
    case DiskState::Checking:
      return "checking its speeds";
    case DiskState::Turning:
      return "turning";
    case DiskState::Paused:
      return "paused";
  }
  return "unknown";
}

const char* to_string(DiskTrouble trouble) {
  switch (trouble) {
    case DiskTrouble::NotTurning:
      return "does not turn";
    case DiskTrouble::NotReached:
      return "speed not reached";
    case DiskTrouble::Reversed:
      return "wrong direction";
    case DiskTrouble::Mismatch:
      return "units do not fit";
    case DiskTrouble::Slip:
      return "slip";
    case DiskTrouble::EncoderSilent:
      return "encoder silent";
    case DiskTrouble::DriveSilent:
      return "drive silent";
    case DiskTrouble::Unasked:
      return "moves unasked";
  }
  return "unknown";
}

}  // namespace stairway::drivers
