// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

#include "drivers/ports/can_port.hpp"

/// The process data of the drive as motor_setup.hpp maps them; little endian, as CiA 301 demands.
namespace stairway::drivers {

/// RPDO 1, to the drive.
struct DriveCommand {
  std::uint16_t control = 0;  ///< controlword, object 6040
  std::int32_t target = 0;    ///< target velocity in the drive's units, object 60FF

  bool operator==(const DriveCommand&) const = default;
};
/// @param node  1..127.
CanFrame encode_command(std::uint8_t node, const DriveCommand& command);

/// TPDO 1, from the drive.
struct DriveStatus {
  std::uint16_t status = 0;   ///< statusword, object 6041
  std::int32_t velocity = 0;  ///< actual velocity in the drive's units, object 606C

  bool operator==(const DriveStatus&) const = default;
};
/// Empty where the frame is shorter than it was mapped; whose frame it is, is not looked at.
std::optional<DriveStatus> decode_status(const CanFrame& frame);

/// TPDO 2, the actual position in the drive's units, object 6064; empty likewise.
std::optional<std::int32_t> decode_position(const CanFrame& frame);

}  // namespace stairway::drivers
