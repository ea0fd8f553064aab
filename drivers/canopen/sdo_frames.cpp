// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "drivers/canopen/sdo_frames.hpp"

#include <algorithm>

#include "drivers/canopen/little_endian.hpp"

namespace stairway::drivers {
namespace {

struct AbortText {
  std::uint32_t code;
  const char* text;
};

constexpr AbortText kAbortTexts[] = {
    {sdo_abort::kToggle, "toggle bit not alternated"},
    {sdo_abort::kTimeout, "time-out"},
    {sdo_abort::kBadCommand, "unknown command"},
    {0x05040002, "bad block size"},
    {0x05040003, "bad sequence number"},
    {0x05040004, "bad checksum"},
    {sdo_abort::kMemory, "out of memory"},
    {0x06010000, "access not supported"},
    {sdo_abort::kWriteOnly, "write-only"},
    {sdo_abort::kReadOnly, "read-only"},
    {sdo_abort::kNoObject, "no such object"},
    {sdo_abort::kCannotMap, "object cannot be mapped into a PDO"},
    {sdo_abort::kPdoLength, "PDO would become too long"},
    {0x06040043, "parameters are incompatible"},
    {0x06040047, "incompatible inside the device"},
    {0x06060000, "hardware error"},
    {sdo_abort::kLength, "length does not match"},
    {0x06070012, "value is too long"},
    {0x06070013, "value is too short"},
    {sdo_abort::kNoSubindex, "no such subindex"},
    {sdo_abort::kBadValue, "value out of range"},
    {0x06090031, "value too high"},
    {0x06090032, "value too low"},
    {0x06090036, "maximum below minimum"},
    {0x060A0023, "resource not available"},
    {0x08000000, "general error"},
    {0x08000020, "cannot be stored"},
    {0x08000021, "under local control"},
    {sdo_abort::kDeviceState, "not in this state of the device"},
    {0x08000023, "no object dictionary"},
    {0x08000024, "no data"},
};

constexpr std::uint8_t kToggleBit = 0x10;
constexpr std::uint8_t kAbortCommand = 0x80;

std::string bytes_of(const CanFrame& frame, std::size_t first, std::size_t count) {
  return {frame.data.begin() + static_cast<std::ptrdiff_t>(first),
          frame.data.begin() + static_cast<std::ptrdiff_t>(first + count)};
}

ObjectAddress object_of(const CanFrame& frame) {
  return {static_cast<std::uint16_t>(load_little_endian(std::span(frame.data).subspan(1), 2)), frame.data[3]};
}

std::uint32_t number_of(const CanFrame& frame) { return load_little_endian(std::span(frame.data).subspan(4), 4); }

// What begins a write and what answers a read look alike: value, or length of the segments to come.
SdoFrame decode_value(SdoKind kind, const CanFrame& frame) {
  const std::uint8_t command = frame.data[0];
  SdoFrame out{.kind = kind, .object = object_of(frame)};
  out.is_expedited = (command & 0x02) != 0;
  const bool is_size_told = (command & 0x01) != 0;
  if (out.is_expedited) {
    out.bytes = bytes_of(frame, 4, is_size_told ? 4U - (command >> 2 & 3U) : 4U);
  } else if (is_size_told) {
    out.number = number_of(frame);
  }
  return out;
}

SdoFrame decode_segment(SdoKind kind, const CanFrame& frame) {
  const std::uint8_t command = frame.data[0];
  SdoFrame out{.kind = kind};
  out.is_toggled = (command & kToggleBit) != 0;
  out.is_last = (command & 0x01) != 0;
  out.bytes = bytes_of(frame, 1, 7U - (command >> 1 & 7U));
  return out;
}

SdoFrame decode_confirmation(SdoKind kind, const CanFrame& frame) {
  SdoFrame out{.kind = kind};
  out.is_toggled = (frame.data[0] & kToggleBit) != 0;
  return out;
}

SdoFrame decode_plain(SdoKind kind, const CanFrame& frame) { return {.kind = kind, .object = object_of(frame)}; }

SdoFrame decode_abort(const CanFrame& frame) {
  SdoFrame out = decode_plain(SdoKind::Abort, frame);
  out.number = number_of(frame);
  return out;
}

void put_value(CanFrame& frame, std::uint8_t command, const SdoFrame& sdo) {
  if (sdo.is_expedited) {
    frame.data[0] = static_cast<std::uint8_t>(command | 0x03 | (4 - sdo.bytes.size()) << 2);
    std::ranges::copy(sdo.bytes, frame.data.begin() + 4);
  } else {
    frame.data[0] = command | 0x01;
    store_little_endian(sdo.number, std::span(frame.data).subspan(4, 4));
  }
}

void put_segment(CanFrame& frame, std::uint8_t command, const SdoFrame& sdo) {
  frame.data[0] = static_cast<std::uint8_t>(command | (sdo.is_toggled ? kToggleBit : 0) | (7 - sdo.bytes.size()) << 1 |
                                            (sdo.is_last ? 1 : 0));
  std::ranges::copy(sdo.bytes, frame.data.begin() + 1);
}

}  // namespace

std::string to_string(ObjectAddress address) { return hex_text(address.index, 4) + ":" + std::to_string(address.sub); }

const char* describe_abort(std::uint32_t code) {
  const auto* known = std::ranges::find(kAbortTexts, code, &AbortText::code);
  return known == std::end(kAbortTexts) ? "unknown reason" : known->text;
}

CanFrame encode_sdo(std::uint16_t id, const SdoFrame& sdo) {
  CanFrame frame{id, 8, {}};
  const std::uint8_t toggle = sdo.is_toggled ? kToggleBit : 0;
  switch (sdo.kind) {
    case SdoKind::DownloadSegment:
    case SdoKind::UploadSegment:
      put_segment(frame, 0x00, sdo);
      return frame;
    case SdoKind::UploadAskSegment:
      frame.data[0] = 0x60 | toggle;
      return frame;
    case SdoKind::SegmentTaken:
      frame.data[0] = 0x20 | toggle;
      return frame;
    case SdoKind::DownloadRequest:
      put_value(frame, 0x20, sdo);
      break;
    case SdoKind::UploadAnswer:
      put_value(frame, 0x40, sdo);
      break;
    case SdoKind::UploadRequest:
      frame.data[0] = 0x40;
      break;
    case SdoKind::DownloadDone:
      frame.data[0] = 0x60;
      break;
    case SdoKind::Abort:
      frame.data[0] = kAbortCommand;
      store_little_endian(sdo.number, std::span(frame.data).subspan(4, 4));
      break;
  }
  store_little_endian(sdo.object.index, std::span(frame.data).subspan(1, 2));
  frame.data[3] = sdo.object.sub;
  return frame;
}

std::optional<SdoFrame> decode_sdo_request(const CanFrame& frame) {
  if (frame.length != 8) return std::nullopt;
  switch (frame.data[0] >> 5) {
    case 0:
      return decode_segment(SdoKind::DownloadSegment, frame);
    case 1:
      return decode_value(SdoKind::DownloadRequest, frame);
    case 2:
      return decode_plain(SdoKind::UploadRequest, frame);
    case 3:
      return decode_confirmation(SdoKind::UploadAskSegment, frame);
    case 4:
      return decode_abort(frame);
    default:
      return std::nullopt;
  }
}

std::optional<SdoFrame> decode_sdo_answer(const CanFrame& frame) {
  if (frame.length != 8) return std::nullopt;
  switch (frame.data[0] >> 5) {
    case 0:
      return decode_segment(SdoKind::UploadSegment, frame);
    case 1:
      return decode_confirmation(SdoKind::SegmentTaken, frame);
    case 2:
      return decode_value(SdoKind::UploadAnswer, frame);
    case 3:
      return decode_plain(SdoKind::DownloadDone, frame);
    case 4:
      return decode_abort(frame);
    default:
      return std::nullopt;
  }
}

}  // namespace stairway::drivers
