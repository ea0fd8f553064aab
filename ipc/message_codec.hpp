// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <tl/expected.hpp>
#include <vector>

#include "ipc/messages.hpp"

namespace stairway::ipc {

/// Why bytes are not a usable message.
enum class MessageFault {
  WrongType,        ///< the fingerprint is that of another type, or of another version of this one
  BadSize,          ///< a list or text is longer than the message, or bytes are left over
  ImpossibleValue,  ///< an enumeration or count outside its range
};
std::string_view to_string(MessageFault fault);

using Bytes = std::vector<std::uint8_t>;

/// Of a point in cloud_slice_t.
inline constexpr std::size_t kCloudPointBytes = 12;

/// The LCM encoding of a message, fingerprint first. Nothing is rounded. A scan whose two lists differ in length is
/// sent as long as its `ranges_m`, missing statuses as Invalid.
Bytes encode(const ScanMessage& message);
Bytes encode(const DiskMessage& message);
Bytes encode(const AnglesMessage& message);
Bytes encode(const StairwaysMessage& message);
Bytes encode(const HealthMessage& message);
Bytes encode(const SettingsMessage& message);
Bytes encode(const CommandMessage& message);
Bytes encode(const CommandAckMessage& message);
Bytes encode(const CloudSliceMessage& message);
Bytes encode(const RawMessage& message);

/// The message in `bytes`, e.g. `decode<ScanMessage>(bytes)`. The bytes may come from anyone: sizes are checked before
/// memory is taken, and whatever is wrong gives an error value.
template <class Message>
tl::expected<Message, MessageFault> decode(std::span<const std::uint8_t> bytes);

template <>
tl::expected<ScanMessage, MessageFault> decode<ScanMessage>(std::span<const std::uint8_t> bytes);
template <>
tl::expected<DiskMessage, MessageFault> decode<DiskMessage>(std::span<const std::uint8_t> bytes);
template <>
tl::expected<AnglesMessage, MessageFault> decode<AnglesMessage>(std::span<const std::uint8_t> bytes);
template <>
tl::expected<StairwaysMessage, MessageFault> decode<StairwaysMessage>(std::span<const std::uint8_t> bytes);
template <>
tl::expected<HealthMessage, MessageFault> decode<HealthMessage>(std::span<const std::uint8_t> bytes);
template <>
tl::expected<SettingsMessage, MessageFault> decode<SettingsMessage>(std::span<const std::uint8_t> bytes);
template <>
tl::expected<CommandMessage, MessageFault> decode<CommandMessage>(std::span<const std::uint8_t> bytes);
template <>
tl::expected<CommandAckMessage, MessageFault> decode<CommandAckMessage>(std::span<const std::uint8_t> bytes);
template <>
tl::expected<CloudSliceMessage, MessageFault> decode<CloudSliceMessage>(std::span<const std::uint8_t> bytes);
template <>
tl::expected<RawMessage, MessageFault> decode<RawMessage>(std::span<const std::uint8_t> bytes);

/// The `utime` with which every message of ours begins, without a look at the rest; empty if there are too few bytes.
std::optional<std::int64_t> message_utime_us(std::span<const std::uint8_t> bytes);

}  // namespace stairway::ipc
