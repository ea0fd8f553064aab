// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "tools/sim/fake_drive_objects.hpp"

#include <utility>

#include "drivers/canopen/canopen_frames.hpp"
#include "drivers/canopen/sdo_frames.hpp"

namespace stairway::sim {
namespace {

using drivers::ObjectAddress;
using drivers::ObjectValue;
namespace objects = drivers::objects;
namespace sdo_abort = drivers::sdo_abort;

constexpr std::uint32_t kOff = 1U << 31;
constexpr std::uint32_t kIdentifier = 0x7ff;
constexpr std::uint32_t kMaxEntries = 8;
constexpr std::uint32_t kPdos = 4;

bool is_between(std::uint16_t index, std::uint16_t first, std::uint16_t last) {
  return index >= first && index <= last;
}
bool is_mapping(std::uint16_t index) { return is_between(index, 0x1600, 0x1603) || is_between(index, 0x1a00, 0x1a03); }
bool is_communication(std::uint16_t index) {
  return is_between(index, 0x1400, 0x1403) || is_between(index, 0x1800, 0x1803);
}

}  // namespace

FakeDriveObjects::FakeDriveObjects(std::uint8_t node, std::string name, std::uint32_t serial)
    : node_(node), name_(std::move(name)), serial_(serial) {
  reset_all();
}

void FakeDriveObjects::add(ObjectAddress object, ObjectValue value, Access access) {
  objects_[object] = {value, access};
}

void FakeDriveObjects::reset_communication() {
  add(objects::kHeartbeatPeriod, {0, 2}, Access::Write);
  add({objects::kHostHeartbeat.index, 0}, {1, 1}, Access::Read);
  add(objects::kHostHeartbeat, {0, 4}, Access::Write);
  add(objects::kCommunicationError, {0, 1}, Access::Write);
  for (std::uint32_t i = 0; i < kPdos; ++i) {
    const auto at = [&](std::uint32_t base) { return static_cast<std::uint16_t>(base + i); };
    for (const bool is_sent : {false, true}) {
      const std::uint32_t identifier = (is_sent ? 0x180U : 0x200U) + 0x100 * i + node_;
      const std::uint16_t communication = at(is_sent ? 0x1800 : 0x1400);
      const std::uint16_t mapping = at(is_sent ? 0x1a00 : 0x1600);
      add({communication, 1}, {identifier | (i == 0 ? 0 : kOff), 4}, Access::Write);
      add({communication, 2}, {255, 1}, Access::Write);
      for (std::uint8_t sub = 1; sub <= kMaxEntries; ++sub) add({mapping, sub}, {0, 4}, Access::Write);
      add({mapping, 0}, {1, 1}, Access::Write);
      const ObjectAddress word = is_sent ? objects::kStatusword : objects::kControlword;
      objects_[{mapping, 1}].value.value = static_cast<std::uint32_t>(word.index) << 16 | 16;
    }
  }
}

void FakeDriveObjects::reset_all() {
  objects_.clear();
  add(objects::kDeviceType, {0x00020192, 4}, Access::Read);
  add({0x1001, 0}, {0, 1}, Access::Read);
  add(objects::kVendor, {0x000001a7, 4}, Access::Read);
  add(objects::kProduct, {0x30000001, 4}, Access::Read);
  add(objects::kRevision, {0x00010002, 4}, Access::Read);
  add(objects::kSerial, {serial_, 4}, Access::Read);
  add(objects::kConnectionLoss, {1, 2}, Access::Write);
  add(objects::kErrorCode, {0, 2}, Access::Read);
  add(objects::kControlword, {0, 2}, Access::Mapped);
  add(objects::kStatusword, {0, 2}, Access::Read);
  add(objects::kQuickStopOption, {2, 2}, Access::Write);
  add(objects::kMode, {1, 1}, Access::Mapped);
  add(objects::kModeDisplay, {1, 1}, Access::Read);
  add(objects::kActualPosition, {0, 4}, Access::Read);
  add(objects::kActualVelocity, {0, 4}, Access::Read);
  add(objects::kAcceleration, {1000, 4}, Access::Mapped);
  add(objects::kDeceleration, {1000, 4}, Access::Mapped);
  add(objects::kQuickStopDeceleration, {10000, 4}, Access::Mapped);
  add(objects::kTargetVelocity, {0, 4}, Access::Mapped);
  add(objects::kSupportedModes, {0x0000002d, 4}, Access::Read);
  reset_communication();
}

tl::expected<std::string, std::uint32_t> FakeDriveObjects::read(ObjectAddress object) const {
  if (object == objects::kDeviceName && !name_.empty()) return name_;
  const auto found = objects_.find(object);
  if (found == objects_.end()) {
    const auto other = objects_.lower_bound({object.index, 0});
    const bool is_index_known = other != objects_.end() && other->first.index == object.index;
    return tl::unexpected(is_index_known ? sdo_abort::kNoSubindex : sdo_abort::kNoObject);
  }
  std::string bytes;
  const ObjectValue value = found->second.value;
  for (int i = 0; i < value.size; ++i) bytes.push_back(static_cast<char>(value.value >> (8 * i)));
  return bytes;
}

tl::expected<void, std::uint32_t> FakeDriveObjects::write(ObjectAddress object, const std::string& bytes) {
  if (const auto old = read(object); !old) return tl::unexpected(old.error());
  const auto found = objects_.find(object);
  if (found == objects_.end() || found->second.access == Access::Read) return tl::unexpected(sdo_abort::kReadOnly);
  if (bytes.size() != found->second.value.size) return tl::unexpected(sdo_abort::kLength);
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    value |= static_cast<std::uint32_t>(static_cast<std::uint8_t>(bytes[i])) << (8 * i);
  }
  if (const std::uint32_t code = refusal(object, value); code != 0) return tl::unexpected(code);
  found->second.value.value = value;
  return {};
}

std::uint32_t FakeDriveObjects::refusal(ObjectAddress object, std::uint32_t value) const {
  if (is_mapping(object.index)) return mapping_refusal(object, value);
  if (is_communication(object.index)) {
    const bool is_on = (get({object.index, 1}) & kOff) == 0;
    const bool changes_identifier = object.sub == 1 && ((get(object) ^ value) & kIdentifier) != 0;
    if (is_on && (changes_identifier || object.sub == 2) && (value & kOff) == 0) return sdo_abort::kDeviceState;
  }
  if (object == objects::kMode && (get(objects::kSupportedModes) & 1U << ((value - 1) & 31)) == 0) {
    return sdo_abort::kBadValue;
  }
  return 0;
}

std::uint32_t FakeDriveObjects::mapping_refusal(ObjectAddress object, std::uint32_t value) const {
  const auto communication = static_cast<std::uint16_t>(object.index - 0x200);
  if ((get({communication, 1}) & kOff) == 0) return sdo_abort::kDeviceState;
  if (object.sub != 0) {
    if (get({object.index, 0}) != 0) return sdo_abort::kDeviceState;
    const ObjectAddress mapped{static_cast<std::uint16_t>(value >> 16), static_cast<std::uint8_t>(value >> 8)};
    const auto found = objects_.find(mapped);
    if (found == objects_.end() || found->second.value.size * 8U != (value & 0xff)) return sdo_abort::kCannotMap;
    const bool is_taken = object.index < 0x1a00;
    return is_taken && found->second.access != Access::Mapped ? sdo_abort::kCannotMap : 0;
  }
  if (value > kMaxEntries) return sdo_abort::kPdoLength;
  std::uint32_t bits = 0;
  for (std::uint8_t sub = 1; sub <= value; ++sub) bits += get({object.index, sub}) & 0xff;
  return bits > 64 ? sdo_abort::kPdoLength : 0;
}

std::uint32_t FakeDriveObjects::get(ObjectAddress object) const {
  const auto found = objects_.find(object);
  return found == objects_.end() ? 0 : found->second.value.value;
}

void FakeDriveObjects::set(ObjectAddress object, std::uint32_t value) {
  if (const auto found = objects_.find(object); found != objects_.end()) found->second.value.value = value;
}

std::uint8_t FakeDriveObjects::size(ObjectAddress object) const {
  const auto found = objects_.find(object);
  return found == objects_.end() ? 0 : found->second.value.size;
}

std::optional<drivers::PdoMap> FakeDriveObjects::pdo(std::uint16_t communication) const {
  const std::uint32_t identifier = get({communication, 1});
  if ((identifier & kOff) != 0) return std::nullopt;
  const auto mapping = static_cast<std::uint16_t>(communication + 0x200);
  drivers::PdoMap map{communication, identifier & kIdentifier, static_cast<std::uint8_t>(get({communication, 2})), {}};
  for (std::uint8_t sub = 1; sub <= get({mapping, 0}); ++sub) {
    const std::uint32_t entry = get({mapping, sub});
    map.objects.push_back({{static_cast<std::uint16_t>(entry >> 16), static_cast<std::uint8_t>(entry >> 8)},
                           static_cast<std::uint8_t>(entry)});
  }
  return map;
}

}  // namespace stairway::sim
