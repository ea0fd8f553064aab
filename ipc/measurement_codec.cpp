// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <stairway/angles_t.hpp>
#include <stairway/disk_t.hpp>
#include <stairway/scan_t.hpp>

#include "ipc/message_codec.hpp"
#include "ipc/message_walker.hpp"
#include "ipc/wire_message.hpp"

namespace stairway::ipc {
namespace {

using wire::enumerator;
using wire::from_bytes;
using wire::kFingerprint;
using wire::kWord;
using wire::to_bytes;

static_assert(scan_t::INVALID == static_cast<int>(drivers::BeamStatus::Invalid));
static_assert(scan_t::NO_RETURN == static_cast<int>(drivers::BeamStatus::NoReturn));
static_assert(disk_t::FAULT_ENCODER == static_cast<int>(DiskFault::Encoder));
static_assert(disk_t::FAULT_MOTOR == static_cast<int>(DiskFault::Motor));
static_assert(disk_t::FAULT_DISK == static_cast<int>(DiskFault::Disk));

bool is_scan(std::span<const std::uint8_t> bytes) {
  MessageWalker walker(bytes);
  walker.skip(kFingerprint + 9 * kWord + 1);
  const std::size_t beams = walker.count();
  walker.skip(4 * beams).skip(beams);
  const std::size_t intensities = walker.count();
  return walker.skip(4 * intensities).ends_here();
}

bool is_disk(std::span<const std::uint8_t> bytes) {
  return MessageWalker(bytes).skip(kFingerprint + 4 * kWord + 1 + kWord + 1).text().ends_here();
}

bool is_angles(std::span<const std::uint8_t> bytes) {
  MessageWalker walker(bytes);
  walker.skip(kFingerprint + 2 * kWord);
  const std::size_t angles = walker.count();
  return walker.skip(angles * (2 * kWord + 1)).ends_here();
}

}  // namespace

Bytes encode(const ScanMessage& message) {
  const drivers::LaserScan& scan = message.scan;
  scan_t wire{};
  wire.utime = message.utime_us;
  wire.sequence = static_cast<std::int64_t>(scan.sequence);
  wire.device_stamp_ms = scan.device_stamp_ms;
  wire.host_stamp_ns = scan.first_beam_stamp_ns;
  wire.beam_interval_ns = scan.beam_interval_ns;
  wire.first_angle_rad = scan.first_angle_rad;
  wire.angle_increment_rad = scan.angle_increment_rad;
  wire.disk_angle_start_rad = message.disk_angle_start_rad;
  wire.disk_angle_end_rad = message.disk_angle_end_rad;
  wire.disk_angle_valid = message.disk_angle_valid;
  wire.num_beams = static_cast<std::int32_t>(scan.ranges_m.size());
  wire.ranges_m = scan.ranges_m;
  wire.statuses.assign(scan.ranges_m.size(), static_cast<std::uint8_t>(drivers::BeamStatus::Invalid));
  const std::size_t known = std::min(scan.statuses.size(), scan.ranges_m.size());
  for (std::size_t i = 0; i < known; ++i) wire.statuses[i] = static_cast<std::uint8_t>(scan.statuses[i]);
  if (scan.intensities.size() == scan.ranges_m.size()) {
    wire.num_intensities = wire.num_beams;
    wire.intensities.assign(scan.intensities.begin(), scan.intensities.end());
  }
  return to_bytes(wire);
}

template <>
tl::expected<ScanMessage, MessageFault> decode<ScanMessage>(std::span<const std::uint8_t> bytes) {
  auto wire = from_bytes<scan_t>(bytes, is_scan);
  if (!wire) return tl::unexpected(wire.error());
  ScanMessage message;
  message.utime_us = wire->utime;
  message.scan.sequence = static_cast<std::uint64_t>(wire->sequence);
  message.scan.device_stamp_ms = wire->device_stamp_ms;
  message.scan.first_beam_stamp_ns = wire->host_stamp_ns;
  message.scan.beam_interval_ns = wire->beam_interval_ns;
  message.scan.first_angle_rad = wire->first_angle_rad;
  message.scan.angle_increment_rad = wire->angle_increment_rad;
  message.scan.ranges_m = std::move(wire->ranges_m);
  message.scan.statuses.reserve(wire->statuses.size());
  for (const std::uint8_t value : wire->statuses) {
    const auto status = enumerator(value, drivers::BeamStatus::Invalid);
    if (!status) return tl::unexpected(MessageFault::ImpossibleValue);
    message.scan.statuses.push_back(*status);
  }
  for (const std::int32_t value : wire->intensities) {
    if (value < 0) return tl::unexpected(MessageFault::ImpossibleValue);
    message.scan.intensities.push_back(static_cast<std::uint32_t>(value));
  }
  const bool has_intensities = !message.scan.intensities.empty();
  if (has_intensities && message.scan.intensities.size() != message.scan.ranges_m.size()) {
    return tl::unexpected(MessageFault::ImpossibleValue);
  }
  message.disk_angle_start_rad = wire->disk_angle_start_rad;
  message.disk_angle_end_rad = wire->disk_angle_end_rad;
  message.disk_angle_valid = wire->disk_angle_valid != 0;
  return message;
}

Bytes encode(const DiskMessage& message) {
  disk_t wire{};
  wire.utime = message.utime_us;
  wire.host_stamp_ns = message.sample.stamp_ns;
  wire.angle_rad = message.sample.angle_rad;
  wire.speed_rad_s = message.speed_rad_s;
  wire.angle_valid = message.sample.valid;
  wire.index_count = message.index_count;
  wire.fault = static_cast<std::int8_t>(message.fault);
  wire.fault_text = message.fault_text;
  return to_bytes(wire);
}

template <>
tl::expected<DiskMessage, MessageFault> decode<DiskMessage>(std::span<const std::uint8_t> bytes) {
  const auto wire = from_bytes<disk_t>(bytes, is_disk);
  if (!wire) return tl::unexpected(wire.error());
  const auto fault = enumerator(wire->fault, DiskFault::Disk);
  if (!fault) return tl::unexpected(MessageFault::ImpossibleValue);
  DiskMessage message;
  message.utime_us = wire->utime;
  message.sample = {wire->host_stamp_ns, wire->angle_rad, wire->angle_valid != 0};
  message.speed_rad_s = wire->speed_rad_s;
  message.index_count = wire->index_count;
  message.fault = *fault;
  message.fault_text = wire->fault_text;
  return message;
}

Bytes encode(const AnglesMessage& message) {
  angles_t wire{};
  wire.utime = message.utime_us;
  wire.scan_stamp_ns = message.scan_stamp_ns;
  wire.num_angles = static_cast<std::int32_t>(message.samples.size());
  for (const drivers::AngleSample& sample : message.samples) {
    wire.stamps_ns.push_back(sample.stamp_ns);
    wire.angles_rad.push_back(sample.angle_rad);
    wire.valid.push_back(sample.valid);
  }
  return to_bytes(wire);
}

template <>
tl::expected<AnglesMessage, MessageFault> decode<AnglesMessage>(std::span<const std::uint8_t> bytes) {
  const auto wire = from_bytes<angles_t>(bytes, is_angles);
  if (!wire) return tl::unexpected(wire.error());
  AnglesMessage message{wire->utime, wire->scan_stamp_ns, {}};
  message.samples.reserve(wire->stamps_ns.size());
  for (std::size_t i = 0; i < wire->stamps_ns.size(); ++i)
    message.samples.push_back({wire->stamps_ns[i], wire->angles_rad[i], wire->valid[i] != 0});
  return message;
}

}  // namespace stairway::ipc
