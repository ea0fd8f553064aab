// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "drivers/canopen/process_data.hpp"

#include <span>

#include "drivers/canopen/canopen_frames.hpp"
#include "drivers/canopen/little_endian.hpp"

namespace stairway::drivers {
namespace {

constexpr std::size_t kWordBytes = 2;
constexpr std::size_t kValueBytes = 4;

}  // namespace

CanFrame encode_command(std::uint8_t node, const DriveCommand& command) {
  CanFrame frame{static_cast<std::uint16_t>(cob::kRpdo1 + node), kWordBytes + kValueBytes, {}};
  store_little_endian(command.control, std::span(frame.data).first(kWordBytes));
  store_little_endian(static_cast<std::uint32_t>(command.target),
                      std::span(frame.data).subspan(kWordBytes, kValueBytes));
  return frame;
}

std::optional<DriveStatus> decode_status(const CanFrame& frame) {
  if (frame.length < kWordBytes + kValueBytes) return std::nullopt;
  const auto status = static_cast<std::uint16_t>(load_little_endian(frame.data, kWordBytes));
  const std::uint32_t velocity = load_little_endian(std::span(frame.data).subspan(kWordBytes), kValueBytes);
  return DriveStatus{status, static_cast<std::int32_t>(velocity)};
}

std::optional<std::int32_t> decode_position(const CanFrame& frame) {
  if (frame.length < kValueBytes) return std::nullopt;
  return static_cast<std::int32_t>(load_little_endian(frame.data, kValueBytes));
}

}  // namespace stairway::drivers
