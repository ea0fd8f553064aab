// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "drivers/canopen/object.hpp"
#include "drivers/ports/can_port.hpp"

namespace stairway::drivers {

/// Why a transfer was aborted, by either side; any other code may come from a drive.
namespace sdo_abort {
inline constexpr std::uint32_t kToggle = 0x05030000;
inline constexpr std::uint32_t kTimeout = 0x05040000;
inline constexpr std::uint32_t kBadCommand = 0x05040001;
inline constexpr std::uint32_t kMemory = 0x05040005;
inline constexpr std::uint32_t kWriteOnly = 0x06010001;
inline constexpr std::uint32_t kReadOnly = 0x06010002;
inline constexpr std::uint32_t kNoObject = 0x06020000;
inline constexpr std::uint32_t kCannotMap = 0x06040041;
inline constexpr std::uint32_t kPdoLength = 0x06040042;
inline constexpr std::uint32_t kLength = 0x06070010;
inline constexpr std::uint32_t kNoSubindex = 0x06090011;
inline constexpr std::uint32_t kBadValue = 0x06090030;
inline constexpr std::uint32_t kDeviceState = 0x08000022;
}  // namespace sdo_abort

/// "no such object"; "unknown reason" for codes that no document lists.
const char* describe_abort(std::uint32_t code);

/// What a frame of a service data transfer does. Its direction decides between those that share a number.
enum class SdoKind : std::uint8_t {
  DownloadSegment,   ///< to the drive: the next 7 bytes
  DownloadRequest,   ///< to the drive: begins a write, with the value when expedited
  UploadRequest,     ///< to the drive: begins a read
  UploadAskSegment,  ///< to the drive: asks for the next 7 bytes
  UploadSegment,     ///< from the drive
  SegmentTaken,      ///< from the drive: confirms DownloadSegment
  UploadAnswer,      ///< from the drive: the value when expedited, else the length of what follows in segments
  DownloadDone,      ///< from the drive: the write is done, or segments may come
  Abort,
};

/// One frame of a transfer, decoded.
struct SdoFrame {
  SdoKind kind = SdoKind::Abort;
  ObjectAddress object;       ///< of all kinds but segments and their confirmations
  bool is_expedited = false;  ///< of DownloadRequest and UploadAnswer
  bool is_toggled = false;    ///< of segments and their confirmations
  bool is_last = false;       ///< of segments
  std::string bytes;          ///< value or segment
  std::uint32_t number = 0;   ///< abort code, or the length of a segmented transfer where it is told [bytes]
  bool operator==(const SdoFrame&) const = default;
};

/// @pre  an expedited value has 1 to 4 bytes, a segment at most 7.
CanFrame encode_sdo(std::uint16_t id, const SdoFrame& frame);
/// Empty when it does not have eight bytes or an unknown command.
std::optional<SdoFrame> decode_sdo_request(const CanFrame& frame);
std::optional<SdoFrame> decode_sdo_answer(const CanFrame& frame);

}  // namespace stairway::drivers
