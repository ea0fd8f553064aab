// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <variant>

namespace stairway::drivers {

enum class DiskState : std::uint8_t {
  Resting,   ///< scanner, drive or encoder are not ready, or were gone for too long
  Checking,  ///< turns slowly while command, drive and encoder are compared
  Turning,   ///< at the wanted speed
  Paused,    ///< stands after a failed check, until the next one
};
const char* to_string(DiskState state);

/// What command, drive and encoder can disagree about; each is counted.
enum class DiskTrouble : std::uint8_t {
  NotTurning,     ///< a speed is wanted, and the disk stands
  NotReached,     ///< it turns at another speed than wanted
  Reversed,       ///< drive or encoder go the other way
  Mismatch,       ///< the drive's and the encoder's units do not fit each other
  Slip,           ///< they did fit, and no longer do
  EncoderSilent,  ///< the drive turns, and the encoder sees nothing
  DriveSilent,    ///< the encoder sees the disk turn, and the drive says that it stands, or nothing
  Unasked,        ///< the disk should stand, and moves
};
inline constexpr std::size_t kDiskTroubles = 8;
const char* to_string(DiskTrouble trouble);

/// Monotonic counts since the start: windows of time in which there was a trouble.
struct DiskCounters {
  std::array<std::uint64_t, kDiskTroubles> troubles{};

  std::uint64_t count(DiskTrouble trouble) const { return troubles[static_cast<std::size_t>(trouble)]; }
};

struct DiskTroubleEvent {
  DiskTrouble trouble = DiskTrouble::NotTurning;
  std::string detail;  ///< for a person: the speeds, and which setting or part looks wrong
};

/// Told when the state or the kind of the problem changes.
struct DiskStateEvent {
  DiskState state = DiskState::Resting;
  std::optional<DiskTroubleEvent> problem;  ///< the trouble that lasts; empty when all is well
};

using DiskEvent = std::variant<DiskStateEvent, DiskTroubleEvent>;

}  // namespace stairway::drivers
