// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include <stairway/command_ack_t.hpp>
#include <stairway/command_t.hpp>

#include "ipc/message_codec.hpp"
#include "ipc/message_walker.hpp"
#include "ipc/wire_message.hpp"

namespace stairway::ipc {
namespace {

using drivers::DiskMode;
using wire::kFingerprint;
using wire::kWord;

static_assert(command_t::SET_SPEED == static_cast<int>(CommandAction::SetSpeed));
static_assert(command_ack_t::TOO_OLD == static_cast<int>(CommandResult::TooOld));
static_assert(command_ack_t::IDLE == static_cast<int>(DiskMode::Idle));

bool is_command(std::span<const std::uint8_t> bytes) {
  return MessageWalker(bytes).skip(kFingerprint + 2 * kWord + 1 + kWord).ends_here();
}

bool is_ack(std::span<const std::uint8_t> bytes) {
  return MessageWalker(bytes).skip(kFingerprint + 2 * kWord + 1).text().skip(1 + kWord).ends_here();
}

}  // namespace

Bytes encode(const CommandMessage& message) {
  command_t wire{};
  wire.utime = message.utime_us;
  wire.id = message.id;
  wire.action = static_cast<std::int8_t>(message.action);
  wire.speed_rad_s = message.speed_rad_s;
  return wire::to_bytes(wire);
}

template <>
tl::expected<CommandMessage, MessageFault> decode<CommandMessage>(std::span<const std::uint8_t> bytes) {
  const auto wire = wire::from_bytes<command_t>(bytes, is_command);
  if (!wire) return tl::unexpected(wire.error());
  const auto action = wire::enumerator(wire->action, CommandAction::Unknown).value_or(CommandAction::Unknown);
  return CommandMessage{wire->utime, wire->id, action, wire->speed_rad_s};
}

Bytes encode(const CommandAckMessage& message) {
  command_ack_t wire{};
  wire.utime = message.utime_us;
  wire.id = message.id;
  wire.result = static_cast<std::int8_t>(message.result);
  wire.text = message.text;
  wire.mode = static_cast<std::int8_t>(message.mode);
  wire.speed_rad_s = message.speed_rad_s;
  return wire::to_bytes(wire);
}

template <>
tl::expected<CommandAckMessage, MessageFault> decode<CommandAckMessage>(std::span<const std::uint8_t> bytes) {
  const auto wire = wire::from_bytes<command_ack_t>(bytes, is_ack);
  if (!wire) return tl::unexpected(wire.error());
  const auto result = wire::enumerator(wire->result, CommandResult::TooOld);
  const auto mode = wire::enumerator(wire->mode, DiskMode::Idle);
  if (!result || !mode) return tl::unexpected(MessageFault::ImpossibleValue);
  return CommandAckMessage{wire->utime, wire->id, *result, wire->text, *mode, wire->speed_rad_s};
}

}  // namespace stairway::ipc
