// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <variant>

#include "drivers/scip/scip_replies.hpp"
#include "drivers/types.hpp"

namespace stairway::drivers {

enum class ScipState {
  Opening,    ///< asking and setting up
  WarmingUp,  ///< its laser is not ready yet, as for some seconds after power-up; it is asked again
  Streaming,  ///< scans arrive, or are missing for less than the watchdog allows
  Backoff,    ///< waiting before opening again
};
const char* to_string(ScipState state);

/// What can go wrong with a sensor; each is counted.
enum class ScipTrouble : std::uint8_t {
  Corrupt,        ///< a message with a bad sum or form; the scan in it is lost
  Overflow,       ///< bytes without an end of message
  Unexpected,     ///< a message that answers nothing that was asked
  NoReply,        ///< a command stayed without an answer
  Refused,        ///< a command was answered with an error status
  SensorFault,    ///< the sensor reports a malfunction; often only a power cycle helps
  SelfCheck,      ///< the sensor interrupts the stream to check itself
  Silence,        ///< the stream stopped
  RepeatedStamp,  ///< three scans carried the same time stamp
  ClockReset,     ///< the sensor's counter was set back
  Disconnected,   ///< the port failed or cannot be opened
  LostBytes,      ///< bytes were dropped on the way, because nobody read in time
  WrongUnit,      ///< a sensor with another serial number than the wanted one, or of another model
  OldFirmware,    ///< a firmware with known faults
  TimeUnknown,    ///< the sensor's clock could not be read, or only too slowly
  FutureStamp,    ///< scan after scan arrived before it ended: their time stamps are wrong
  SyncPulse,      ///< sync pulses come, but not where the settings expect them
};
inline constexpr std::size_t kScipTroubles = 17;
const char* to_string(ScipTrouble trouble);

/// Monotonic counts since the session began.
struct ScipCounters {
  std::uint64_t scans = 0;
  std::array<std::uint64_t, kScipTroubles> troubles{};

  std::uint64_t count(ScipTrouble trouble) const { return troubles[static_cast<std::size_t>(trouble)]; }
};

/// What VV, PP and II said when the sensor was opened.
struct ScipDeviceInfo {
  VersionInfo version;
  SensorParameters parameters;
  SensorState state;
};

struct ScipTroubleEvent {
  ScipTrouble trouble = ScipTrouble::Corrupt;
  std::string detail;  ///< for a person: what came, what was asked
};

struct ScipStateEvent {
  ScipState state = ScipState::Opening;
};

/// The sensor did not come back by talking to it: close the port and open it again.
struct ScipReopenEvent {};

using ScipEvent = std::variant<LaserScan, ScipDeviceInfo, ScipTroubleEvent, ScipStateEvent, ScipReopenEvent>;

}  // namespace stairway::drivers
