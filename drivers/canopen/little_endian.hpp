// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

namespace stairway::drivers {

/// The first `size` bytes, least significant first; missing ones count as 0. @pre size <= 4.
inline std::uint32_t load_little_endian(std::span<const std::uint8_t> bytes, std::size_t size) {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < size && i < bytes.size(); ++i) value |= static_cast<std::uint32_t>(bytes[i]) << (8 * i);
  return value;
}

/// Writes the lower bytes of `value` over all of `bytes`, least significant first. @pre bytes.size() <= 4.
inline void store_little_endian(std::uint32_t value, std::span<std::uint8_t> bytes) {
  for (std::size_t i = 0; i < bytes.size(); ++i) bytes[i] = static_cast<std::uint8_t>(value >> (8 * i));
}

/// The last `digits` hexadecimal digits, as CANopen's documents write numbers: 6040, 0F, 05040000.
inline std::string hex_text(std::uint32_t value, int digits) {
  std::string out;
  for (int shift = 4 * (digits - 1); shift >= 0; shift -= 4) out += "0123456789ABCDEF"[value >> shift & 0xf];
  return out;
}

}  // namespace stairway::drivers
