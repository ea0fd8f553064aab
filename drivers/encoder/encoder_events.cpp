// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "drivers/encoder/encoder_events.hpp"

namespace stairway::drivers {

const char* to_string(EncoderState state) {
  switch (state) {
    case EncoderState::Absent:
      return "absent";
    case EncoderState::Unindexed:
      return "waiting for the index";
    case EncoderState::Indexed:
      return "indexed";
  }
  return "unknown";
}

const char* to_string(EncoderTrouble trouble) {
  switch (trouble) {
    case EncoderTrouble::Disconnected:
      return "disconnected";
    case EncoderTrouble::LostEdges:
      return "lost edges";
    case EncoderTrouble::IllegalTransition:
      return "illegal transition";
    case EncoderTrouble::MissedPair:
      return "missed pair of edges";
    case EncoderTrouble::IndexDeviation:
      return "index deviation";
    case EncoderTrouble::IndexMissing:
      return "index missing";
    case EncoderTrouble::DeadLine:
      return "dead line";
    case EncoderTrouble::EdgeRate:
      return "edge rate";
  }
  return "unknown";
}

}  // namespace stairway::drivers
