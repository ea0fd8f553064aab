// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include "drivers/types.hpp"

namespace stairway::drivers {

enum class EncoderState : std::uint8_t {
  Absent,     ///< the lines cannot be opened; tried again without end
  Unindexed,  ///< edges count, but the index has not been seen since the start or the last fault
  Indexed,    ///< angles are valid
};
const char* to_string(EncoderState state);

/// What can go wrong with the encoder; each is counted.
enum class EncoderTrouble : std::uint8_t {
  Disconnected,       ///< the GPIO chip is missing, refuses the lines, or was removed
  LostEdges,          ///< the kernel dropped edges
  IllegalTransition,  ///< both lines changed at once: at least one edge was lost
  MissedPair,         ///< a line rose twice in a row, or fell: a pair of edges was lost
  IndexDeviation,     ///< the index came at another count than a revolution asks for
  IndexMissing,       ///< no index within one and a half revolutions
  DeadLine,           ///< one line changes and the other does not, for an eighth of a revolution
  EdgeRate,           ///< edges come faster than the kernel's queue is safe for
};
inline constexpr std::size_t kEncoderTroubles = 8;
const char* to_string(EncoderTrouble trouble);

/// Monotonic counts since the session began.
struct EncoderCounters {
  std::uint64_t edges = 0;
  std::uint64_t indices = 0;
  std::uint64_t lost_edges = 0;  ///< as the kernel told; not all kernels do
  std::array<std::uint64_t, kEncoderTroubles> troubles{};

  std::uint64_t count(EncoderTrouble trouble) const { return troubles[static_cast<std::size_t>(trouble)]; }
};

struct EncoderStateEvent {
  EncoderState state = EncoderState::Absent;
};

struct EncoderTroubleEvent {
  EncoderTrouble trouble = EncoderTrouble::Disconnected;
  std::string detail;  ///< for a person: what came, what was expected, what to do
};

using EncoderEvent = std::variant<std::vector<AngleSample>, EncoderStateEvent, EncoderTroubleEvent>;

}  // namespace stairway::drivers
