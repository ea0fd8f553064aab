// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <lcm/lcm_coretypes.h>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <tl/expected.hpp>

#include "ipc/message_codec.hpp"

/// Between bytes and the types that lcm-gen makes; for the codecs.
namespace stairway::ipc::wire {

inline constexpr std::size_t kFingerprint = 8;  ///< comes first
inline constexpr std::size_t kWord = 8;         ///< int64_t and double

template <class Wire>
bool has_fingerprint(std::span<const std::uint8_t> bytes) {
  if (bytes.size() < kFingerprint) return false;
  std::int64_t fingerprint = 0;
  __int64_t_decode_array(bytes.data(), 0, kFingerprint, &fingerprint, 1);
  return fingerprint == Wire::getHash();
}

/// @param has_layout  whether the bytes, counted field by field, end where a message of this type ends.
template <class Wire, class HasLayout>
tl::expected<Wire, MessageFault> from_bytes(std::span<const std::uint8_t> bytes, HasLayout has_layout) {
  if (!has_fingerprint<Wire>(bytes)) return tl::unexpected(MessageFault::WrongType);
  if (!has_layout(bytes)) return tl::unexpected(MessageFault::BadSize);
  Wire wire{};
  if (wire.decode(bytes.data(), 0, static_cast<int>(bytes.size())) < 0) return tl::unexpected(MessageFault::BadSize);
  return wire;
}

template <class Wire>
Bytes to_bytes(const Wire& wire) {
  Bytes bytes(static_cast<std::size_t>(wire.getEncodedSize()));
  wire.encode(bytes.data(), 0, static_cast<int>(bytes.size()));
  return bytes;
}

/// The enumerator number `value`, if there is one up to `last`.
template <class Enum>
std::optional<Enum> enumerator(int value, Enum last) {
  if (value < 0 || value > static_cast<int>(last)) return std::nullopt;
  return static_cast<Enum>(value);
}

}  // namespace stairway::ipc::wire
