// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <compare>
#include <cstdint>
#include <string>

namespace stairway::drivers {

/// Place of a value in a node's object dictionary.
struct ObjectAddress {
  std::uint16_t index = 0;
  std::uint8_t sub = 0;

  auto operator<=>(const ObjectAddress&) const = default;
};
/// As CANopen's documents write it: 1018:1.
std::string to_string(ObjectAddress address);

/// A number as it stands in an object: the lower `size` bytes of `value`.
struct ObjectValue {
  std::uint32_t value = 0;
  std::uint8_t size = 4;  ///< [bytes], 1, 2 or 4

  bool operator==(const ObjectValue&) const = default;
};

/// The objects that driving the disk takes.
namespace objects {
inline constexpr ObjectAddress kDeviceType{0x1000, 0};
inline constexpr ObjectAddress kDeviceName{0x1008, 0};
inline constexpr ObjectAddress kHostHeartbeat{0x1016, 1};
inline constexpr ObjectAddress kHeartbeatPeriod{0x1017, 0};
inline constexpr ObjectAddress kVendor{0x1018, 1};
inline constexpr ObjectAddress kProduct{0x1018, 2};
inline constexpr ObjectAddress kRevision{0x1018, 3};
inline constexpr ObjectAddress kSerial{0x1018, 4};
inline constexpr ObjectAddress kCommunicationError{0x1029, 1};
inline constexpr ObjectAddress kConnectionLoss{0x6007, 0};
inline constexpr ObjectAddress kErrorCode{0x603f, 0};
inline constexpr ObjectAddress kControlword{0x6040, 0};
inline constexpr ObjectAddress kStatusword{0x6041, 0};
inline constexpr ObjectAddress kQuickStopOption{0x605a, 0};
inline constexpr ObjectAddress kMode{0x6060, 0};
inline constexpr ObjectAddress kModeDisplay{0x6061, 0};
inline constexpr ObjectAddress kActualPosition{0x6064, 0};
inline constexpr ObjectAddress kActualVelocity{0x606c, 0};
inline constexpr ObjectAddress kAcceleration{0x6083, 0};
inline constexpr ObjectAddress kDeceleration{0x6084, 0};
inline constexpr ObjectAddress kQuickStopDeceleration{0x6085, 0};
inline constexpr ObjectAddress kTargetVelocity{0x60ff, 0};
inline constexpr ObjectAddress kSupportedModes{0x6502, 0};
}  // namespace objects

}  // namespace stairway::drivers
