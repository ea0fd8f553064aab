// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>

#include "drivers/ports/can_port.hpp"

namespace stairway::drivers {

/// Identifiers of CANopen's default connection set; the node's number is added to all but the first two. T and R are
/// from the drive's view.
namespace cob {
inline constexpr std::uint16_t kNmt = 0x000;
inline constexpr std::uint16_t kSync = 0x080;
inline constexpr std::uint16_t kEmergency = 0x080;
inline constexpr std::uint16_t kTpdo1 = 0x180;
inline constexpr std::uint16_t kTpdo2 = 0x280;
inline constexpr std::uint16_t kRpdo1 = 0x200;
inline constexpr std::uint16_t kSdoAnswer = 0x580;
inline constexpr std::uint16_t kSdoRequest = 0x600;
inline constexpr std::uint16_t kHeartbeat = 0x700;
}  // namespace cob

enum class NmtCommand : std::uint8_t {
  Start = 0x01,
  Stop = 0x02,
  EnterPreOperational = 0x80,
  ResetNode = 0x81,
  ResetCommunication = 0x82,
};

enum class NmtState : std::uint8_t { BootUp = 0x00, Stopped = 0x04, Operational = 0x05, PreOperational = 0x7f };
const char* to_string(NmtState state);

/// @param node  1..127, 0 for all.
CanFrame encode_nmt(NmtCommand command, std::uint8_t node);
CanFrame encode_sync();
CanFrame encode_heartbeat(std::uint8_t node, NmtState state);
/// Empty unless it has one byte that names a state; the toggle bit of node guarding is ignored.
std::optional<NmtState> decode_heartbeat(const CanFrame& frame);

/// What a node says on its own when something is wrong (EMCY).
struct Emergency {
  std::uint16_t code = 0;  ///< 0 takes all errors back
  std::uint8_t error_register = 0;
  std::array<std::uint8_t, 5> vendor_bytes{};

  bool operator==(const Emergency&) const = default;
};
CanFrame encode_emergency(std::uint8_t node, const Emergency& emergency);
/// Empty unless it has eight bytes.
std::optional<Emergency> decode_emergency(const CanFrame& frame);

/// What an error code of EMCY or object 603F means; by its class when the code itself is not known.
const char* describe_error_code(std::uint16_t code);
/// Code and meaning, register and all vendor bytes.
std::string describe(const Emergency& emergency);

/// As candump prints it: `601#2B40600006000000`.
std::string to_string(const CanFrame& frame);

}  // namespace stairway::drivers
