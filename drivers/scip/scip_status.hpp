// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

namespace stairway::drivers {

/// What the two characters of a status mean, so far as the session has to decide on them.
enum class StatusKind {
  Ok,         ///< 00, and 99 with a scan
  Unknown,    ///< 0D, 0E: the sensor does not know this command, or not in this form
  SelfCheck,  ///< 21..49 inside a stream: it pauses to check an error
  Resumed,    ///< 98 inside a stream: the check has ended
  Fault,      ///< 50..97 inside a stream, 01 after BM: laser or motor are out of order
  Refused,    ///< all others
};

/// @param symbol  of the command that was answered, e.g. "MD"; the same status means different things to different
/// ones.
StatusKind status_kind(std::string_view symbol, std::string_view status);

/// The status with its meaning, for a person: "04 (last step out of range)". Bounded, whatever the sensor sent.
std::string describe_status(std::string_view symbol, std::string_view status);

}  // namespace stairway::drivers
