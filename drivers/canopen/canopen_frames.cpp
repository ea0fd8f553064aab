// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "drivers/canopen/canopen_frames.hpp"

#include <algorithm>

#include "drivers/canopen/little_endian.hpp"

namespace stairway::drivers {
namespace {

struct CodeText {
  std::uint16_t code;
  std::uint16_t mask;
  const char* text;
};

// The first match counts.
constexpr CodeText kCodeTexts[] = {
    {0x0000, 0xffff, "no error"},
    {0x2310, 0xffff, "overcurrent at the motor"},
    {0x3210, 0xffff, "supply voltage too high"},
    {0x3220, 0xffff, "supply voltage too low"},
    {0x4210, 0xffff, "drive too hot"},
    {0x4310, 0xffff, "drive too hot"},
    {0x7305, 0xffff, "motor encoder"},
    {0x8110, 0xffff, "CAN messages lost in the drive"},
    {0x8120, 0xffff, "CAN error passive"},
    {0x8130, 0xffff, "the drive missed this host's heartbeat"},
    {0x8140, 0xffff, "recovered from bus-off"},
    {0x8150, 0xffff, "two nodes use one identifier"},
    {0x8210, 0xffff, "PDO too short"},
    {0x8220, 0xffff, "PDO too long"},
    {0x8400, 0xff00, "speed cannot be followed"},
    {0x8500, 0xff00, "position"},
    {0x8611, 0xffff, "following error"},
    {0x2000, 0xf000, "current"},
    {0x3000, 0xf000, "voltage"},
    {0x4000, 0xf000, "temperature"},
    {0x5000, 0xf000, "drive hardware"},
    {0x6000, 0xf000, "drive software or parameters"},
    {0x7000, 0xf000, "additional module"},
    {0x8100, 0xff00, "communication"},
    {0x8200, 0xff00, "CANopen protocol"},
    {0x8000, 0xf000, "monitoring"},
    {0x9000, 0xff00, "external error"},
    {0xf000, 0xff00, "additional function"},
    {0xff00, 0xff00, "see the drive's manual"},
    {0x1000, 0xf000, "generic error"},
};

}  // namespace

const char* to_string(NmtState state) {
  switch (state) {
    case NmtState::BootUp:
      return "boot-up";
    case NmtState::Stopped:
      return "stopped";
    case NmtState::Operational:
      return "operational";
    case NmtState::PreOperational:
      return "pre-operational";
  }
  return "unknown";
}

CanFrame encode_nmt(NmtCommand command, std::uint8_t node) {
  return {cob::kNmt, 2, {static_cast<std::uint8_t>(command), node}};
}

CanFrame encode_sync() { return {cob::kSync, 0, {}}; }

CanFrame encode_heartbeat(std::uint8_t node, NmtState state) {
  return {static_cast<std::uint16_t>(cob::kHeartbeat + node), 1, {static_cast<std::uint8_t>(state)}};
}

std::optional<NmtState> decode_heartbeat(const CanFrame& frame) {
  if (frame.length != 1) return std::nullopt;
  const auto state = static_cast<NmtState>(frame.data[0] & 0x7f);
  const bool is_known = state == NmtState::BootUp || state == NmtState::Stopped || state == NmtState::Operational ||
                        state == NmtState::PreOperational;
  return is_known ? std::optional(state) : std::nullopt;
}

CanFrame encode_emergency(std::uint8_t node, const Emergency& emergency) {
  CanFrame frame{static_cast<std::uint16_t>(cob::kEmergency + node), 8, {}};
  store_little_endian(emergency.code, std::span(frame.data).first(2));
  frame.data[2] = emergency.error_register;
  std::ranges::copy(emergency.vendor_bytes, frame.data.begin() + 3);
  return frame;
}

std::optional<Emergency> decode_emergency(const CanFrame& frame) {
  if (frame.length != 8) return std::nullopt;
  Emergency emergency;
  emergency.code = static_cast<std::uint16_t>(load_little_endian(frame.data, 2));
  emergency.error_register = frame.data[2];
  std::copy(frame.data.begin() + 3, frame.data.end(), emergency.vendor_bytes.begin());
  return emergency;
}

const char* describe_error_code(std::uint16_t code) {
  const auto known =
      std::ranges::find_if(kCodeTexts, [&](const CodeText& entry) { return (code & entry.mask) == entry.code; });
  return known == std::end(kCodeTexts) ? "unknown error" : known->text;
}

std::string describe(const Emergency& emergency) {
  std::string out = hex_text(emergency.code, 4) + " (" + describe_error_code(emergency.code) + "), error register " +
                    hex_text(emergency.error_register, 2) + ", vendor bytes";
  for (const std::uint8_t byte : emergency.vendor_bytes) out += " " + hex_text(byte, 2);
  return out;
}

std::string to_string(const CanFrame& frame) {
  std::string out = hex_text(frame.id, 3) + "#";
  for (const std::uint8_t byte : frame.payload()) out += hex_text(byte, 2);
  return out;
}

}  // namespace stairway::drivers
