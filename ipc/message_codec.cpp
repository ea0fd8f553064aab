// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "ipc/message_codec.hpp"

#include <stairway/settings_t.hpp>

#include "ipc/message_walker.hpp"
#include "ipc/wire_message.hpp"

namespace stairway::ipc {
namespace {

using wire::from_bytes;
using wire::kFingerprint;
using wire::kWord;
using wire::to_bytes;

bool is_settings(std::span<const std::uint8_t> bytes) {
  return MessageWalker(bytes).skip(kFingerprint + kWord).text().text().ends_here();
}

}  // namespace

std::string_view to_string(MessageFault fault) {
  switch (fault) {
    case MessageFault::WrongType:
      return "wrong-type";
    case MessageFault::BadSize:
      return "bad-size";
    case MessageFault::ImpossibleValue:
      break;
  }
  return "impossible-value";
}

Bytes encode(const SettingsMessage& message) {
  settings_t wire{};
  wire.utime = message.utime_us;
  wire.version = message.version;
  wire.toml = message.toml;
  return to_bytes(wire);
}

template <>
tl::expected<SettingsMessage, MessageFault> decode<SettingsMessage>(std::span<const std::uint8_t> bytes) {
  const auto wire = from_bytes<settings_t>(bytes, is_settings);
  if (!wire) return tl::unexpected(wire.error());
  return SettingsMessage{wire->utime, wire->version, wire->toml};
}

std::optional<std::int64_t> message_utime_us(std::span<const std::uint8_t> bytes) {
  if (bytes.size() < kFingerprint + kWord) return std::nullopt;
  std::int64_t utime_us = 0;
  __int64_t_decode_array(bytes.data(), kFingerprint, kWord, &utime_us, 1);
  return utime_us;
}

}  // namespace stairway::ipc
