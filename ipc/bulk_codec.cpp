// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include <bit>
#include <cstring>
#include <stairway/cloud_slice_t.hpp>
#include <stairway/raw_t.hpp>

#include "ipc/message_codec.hpp"
#include "ipc/message_walker.hpp"
#include "ipc/wire_message.hpp"

namespace stairway::ipc {
namespace {

using wire::kFingerprint;
using wire::kWord;

static_assert(std::endian::native == std::endian::little, "points are copied as they lie in memory");
static_assert(sizeof(Eigen::Vector3f) == kCloudPointBytes);

bool is_slice(std::span<const std::uint8_t> bytes) {
  MessageWalker walker(bytes);
  walker.skip(kFingerprint + 3 * kWord + 4 * 4);
  const std::size_t size = walker.count();
  return walker.skip(size).ends_here();
}

bool is_raw(std::span<const std::uint8_t> bytes) {
  MessageWalker walker(bytes);
  walker.skip(kFingerprint + 2 * kWord).text().skip(1);
  const std::size_t size = walker.count();
  return walker.skip(size).ends_here();
}

}  // namespace

Bytes encode(const CloudSliceMessage& message) {
  cloud_slice_t wire{};
  wire.utime = message.utime_us;
  wire.sweep_start_utime = message.sweep_start_utime_us;
  wire.sweep = message.sweep;
  wire.slice = message.slice;
  wire.num_slices = message.slices;
  wire.first_point = message.first_point;
  wire.num_sweep_points = message.sweep_points;
  wire.points.resize(message.points.size() * kCloudPointBytes);
  wire.num_bytes = static_cast<std::int32_t>(wire.points.size());
  if (!message.points.empty()) std::memcpy(wire.points.data(), message.points.front().data(), wire.points.size());
  return wire::to_bytes(wire);
}

template <>
tl::expected<CloudSliceMessage, MessageFault> decode<CloudSliceMessage>(std::span<const std::uint8_t> bytes) {
  const auto wire = wire::from_bytes<cloud_slice_t>(bytes, is_slice);
  if (!wire) return tl::unexpected(wire.error());
  if (wire->points.size() % kCloudPointBytes != 0) return tl::unexpected(MessageFault::ImpossibleValue);
  CloudSliceMessage message{wire->utime,       wire->sweep_start_utime, wire->sweep, wire->slice, wire->num_slices,
                            wire->first_point, wire->num_sweep_points,  {}};
  message.points.resize(wire->points.size() / kCloudPointBytes);
  if (!message.points.empty()) std::memcpy(message.points.front().data(), wire->points.data(), wire->points.size());
  return message;
}

Bytes encode(const RawMessage& message) {
  raw_t wire{};
  wire.utime = message.utime_us;
  wire.host_stamp_ns = message.host_stamp_ns;
  wire.device = message.device;
  wire.is_sent = message.is_sent;
  wire.bytes.assign(message.bytes.begin(), message.bytes.end());
  wire.num_bytes = static_cast<std::int32_t>(wire.bytes.size());
  return wire::to_bytes(wire);
}

template <>
tl::expected<RawMessage, MessageFault> decode<RawMessage>(std::span<const std::uint8_t> bytes) {
  const auto wire = wire::from_bytes<raw_t>(bytes, is_raw);
  if (!wire) return tl::unexpected(wire.error());
  return RawMessage{wire->utime, wire->host_stamp_ns, wire->device, wire->is_sent != 0,
                    std::string(wire->bytes.begin(), wire->bytes.end())};
}

}  // namespace stairway::ipc
