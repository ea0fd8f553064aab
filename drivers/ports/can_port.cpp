// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "drivers/ports/can_port.hpp"

namespace stairway::drivers {

const char* to_string(CanCondition condition) {
  switch (condition) {
    case CanCondition::Active:
      return "errors are rare again";
    case CanCondition::Warning:
      return "errors become frequent";
    case CanCondition::Passive:
      return "many errors: the controller is passive";
    case CanCondition::BusOff:
      return "bus-off: the controller has left the bus";
    case CanCondition::Restarted:
      return "the controller is back on the bus";
    case CanCondition::Unheard:
      return "nobody acknowledges: is the drive powered, the bus terminated, the bit rate right?";
    case CanCondition::TransmitStuck:
      return "a frame could not be sent in time";
    case CanCondition::Overrun:
      return "frames were lost because they were not read in time";
    case CanCondition::LinkDown:
      return "the interface is down";
    case CanCondition::LinkUp:
      return "the interface is up";
  }
  return "unknown";
}

}  // namespace stairway::drivers
