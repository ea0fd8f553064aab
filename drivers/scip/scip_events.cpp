// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "drivers/scip/scip_events.hpp"

namespace stairway::drivers {

const char* to_string(ScipState state) {
  switch (state) {
    case ScipState::Opening:
      return "opening";
    case ScipState::WarmingUp:
      return "warming up";
    case ScipState::Streaming:
      return "streaming";
    case ScipState::Backoff:
      return "backoff";
  }
  return "unknown";
}

const char* to_string(ScipTrouble trouble) {
  switch (trouble) {
    case ScipTrouble::Corrupt:
      return "corrupt message";
    case ScipTrouble::Overflow:
      return "message without end";
    case ScipTrouble::Unexpected:
      return "unexpected message";
    case ScipTrouble::NoReply:
      return "no reply";
    case ScipTrouble::Refused:
      return "command refused";
    case ScipTrouble::SensorFault:
      return "sensor fault";
    case ScipTrouble::SelfCheck:
      return "sensor checks itself";
    case ScipTrouble::Silence:
      return "stream silent";
    case ScipTrouble::RepeatedStamp:
      return "repeated time stamp";
    case ScipTrouble::ClockReset:
      return "sensor clock set back";
    case ScipTrouble::Disconnected:
      return "disconnected";
    case ScipTrouble::LostBytes:
      return "bytes lost";
    case ScipTrouble::WrongUnit:
      return "another unit";
    case ScipTrouble::OldFirmware:
      return "old firmware";
    case ScipTrouble::TimeUnknown:
      return "sensor clock unknown";
    case ScipTrouble::FutureStamp:
      return "stamp in the future";
    case ScipTrouble::SyncPulse:
      return "sync pulses misplaced";
  }
  return "unknown";
}

}  // namespace stairway::drivers
