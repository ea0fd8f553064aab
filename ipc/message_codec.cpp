// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "ipc/message_codec.hpp"

#include <algorithm>
#include <optional>
#include <stairway/angles_t.hpp>
#include <stairway/disk_t.hpp>
#include <stairway/health_t.hpp>
#include <stairway/scan_t.hpp>
#include <stairway/settings_t.hpp>
#include <stairway/stairways_t.hpp>

#include "ipc/message_walker.hpp"
#include "ipc/wire_message.hpp"

namespace stairway::ipc {
namespace {

using wire::enumerator;
using wire::kFingerprint;
using wire::kWord;
using wire::to_bytes;

// Layouts of the types in ipc/types, field by field.

bool has_layout(std::span<const std::uint8_t> bytes, const scan_t*) {
  MessageWalker walker(bytes);
  walker.skip(kFingerprint + 9 * kWord + 1);
  const std::size_t beams = walker.count();
  walker.skip(4 * beams).skip(beams);
  const std::size_t intensities = walker.count();
  return walker.skip(4 * intensities).ends_here();
}

bool has_layout(std::span<const std::uint8_t> bytes, const disk_t*) {
  return MessageWalker(bytes).skip(kFingerprint + 4 * kWord + 1 + kWord + 1).text().ends_here();
}

bool has_layout(std::span<const std::uint8_t> bytes, const angles_t*) {
  MessageWalker walker(bytes);
  walker.skip(kFingerprint + 2 * kWord);
  const std::size_t angles = walker.count();
  return walker.skip(angles * (2 * kWord + 1)).ends_here();
}

void walk_stairway(MessageWalker& walker) {
  walker.skip(2 * kWord + 2 + 13 * kWord + 3);
  const std::size_t nosings = walker.count();
  walker.skip(nosings * 6 * kWord + kWord);
}

void walk_rejection(MessageWalker& walker) {
  walker.text().text();
  const std::size_t figures = walker.count();
  walker.texts(figures).skip(figures * kWord);
}

bool has_layout(std::span<const std::uint8_t> bytes, const stairways_t*) {
  MessageWalker walker(bytes);
  walker.skip(kFingerprint + 3 * kWord + 1);
  const std::size_t stairways = walker.count();
  for (std::size_t i = 0; i < stairways && walker.fits(); ++i) walk_stairway(walker);
  const std::size_t rejected = walker.count();
  for (std::size_t i = 0; i < rejected && walker.fits(); ++i) walk_rejection(walker);
  return walker.ends_here();
}

bool has_layout(std::span<const std::uint8_t> bytes, const health_t*) {
  MessageWalker walker(bytes);
  walker.skip(kFingerprint + kWord).text();
  walker.texts(walker.count()).skip(5 * kWord);
  const std::size_t drops = walker.count();
  walker.texts(drops).skip(drops * kWord);
  const std::size_t devices = walker.count();
  walker.texts(3 * devices).skip(devices * (1 + 3 * kWord)).skip(1 + 9 * kWord);
  const std::size_t stages = walker.count();
  walker.texts(stages).skip(stages * 2 * kWord).skip(3 * kWord).text();
  return walker.skip(4 + 2 * kWord).ends_here();
}

bool has_layout(std::span<const std::uint8_t> bytes, const settings_t*) {
  return MessageWalker(bytes).skip(kFingerprint + kWord).text().text().ends_here();
}

template <class Wire>
tl::expected<Wire, MessageFault> from_bytes(std::span<const std::uint8_t> bytes) {
  const Wire* type = nullptr;
  return wire::from_bytes<Wire>(bytes, [type](std::span<const std::uint8_t> all) { return has_layout(all, type); });
}

static_assert(scan_t::INVALID == static_cast<int>(drivers::BeamStatus::Invalid));
static_assert(scan_t::NO_RETURN == static_cast<int>(drivers::BeamStatus::NoReturn));
static_assert(disk_t::FAULT_ENCODER == static_cast<int>(DiskFault::Encoder));
static_assert(disk_t::FAULT_MOTOR == static_cast<int>(DiskFault::Motor));
static_assert(disk_t::FAULT_DISK == static_cast<int>(DiskFault::Disk));
static_assert(stairway_t::SPIRAL == static_cast<int>(detect::StairwayKind::Spiral));
static_assert(stairway_t::DESCENDING == static_cast<int>(detect::StairwayDirection::Descending));
static_assert(stairway_t::MIDDLE == static_cast<int>(detect::AnchorSide::Middle));
static_assert(stairway_t::RIGHT == static_cast<int>(detect::AnchorSide::Right));
static_assert(health_t::CLOCK_TIME_ADJUSTMENT == static_cast<int>(drivers::ClockSource::TimeAdjustment));
static_assert(health_t::CLOCK_SYNC_PULSE == static_cast<int>(drivers::ClockSource::SyncPulse));

stairway_t to_wire(const detect::Stairway& stairway, std::int64_t utime_us, std::int64_t track_id) {
  stairway_t wire{};
  wire.utime = utime_us;
  wire.track_id = track_id;
  wire.kind = static_cast<std::int8_t>(stairway.kind);
  wire.direction = static_cast<std::int8_t>(stairway.direction);
  wire.step_height_m = stairway.step_height;
  wire.step_depth_m = stairway.step_depth;
  wire.width_m = stairway.width;
  wire.pitch_rad = stairway.pitch();
  wire.heading_rad = stairway.heading;
  wire.turn_per_step_rad = stairway.turn_per_step;
  wire.step_height_sigma_m = stairway.step_height_sigma;
  wire.step_depth_sigma_m = stairway.step_depth_sigma;
  wire.width_sigma_m = stairway.width_sigma;
  wire.heading_sigma_rad = stairway.heading_sigma;
  std::copy_n(stairway.anchor.data(), 3, wire.anchor_m);
  wire.anchor_side = static_cast<std::int8_t>(stairway.anchor_side);
  wire.railing_left = stairway.railing_left;
  wire.railing_right = stairway.railing_right;
  wire.num_nosings = static_cast<std::int32_t>(stairway.nosings.size());
  for (const detect::Nosing& nosing : stairway.nosings) {
    nosing_t& edge = wire.nosings.emplace_back();
    std::copy_n(nosing.left.data(), 3, edge.left_m);
    std::copy_n(nosing.right.data(), 3, edge.right_m);
  }
  wire.score = stairway.score;
  return wire;
}

std::optional<detect::Stairway> from_wire(const stairway_t& wire) {
  const auto kind = enumerator(wire.kind, detect::StairwayKind::Spiral);
  const auto direction = enumerator(wire.direction, detect::StairwayDirection::Descending);
  const auto anchor_side = enumerator(wire.anchor_side, detect::AnchorSide::Right);
  if (!kind || !direction || !anchor_side) return std::nullopt;
  detect::Stairway stairway;
  stairway.kind = *kind;
  stairway.direction = *direction;
  stairway.step_height = wire.step_height_m;
  stairway.step_depth = wire.step_depth_m;
  stairway.width = wire.width_m;
  stairway.heading = wire.heading_rad;
  stairway.turn_per_step = wire.turn_per_step_rad;
  stairway.step_height_sigma = wire.step_height_sigma_m;
  stairway.step_depth_sigma = wire.step_depth_sigma_m;
  stairway.width_sigma = wire.width_sigma_m;
  stairway.heading_sigma = wire.heading_sigma_rad;
  stairway.anchor = Eigen::Vector3d(wire.anchor_m);
  stairway.anchor_side = *anchor_side;
  stairway.railing_left = wire.railing_left != 0;
  stairway.railing_right = wire.railing_right != 0;
  for (const nosing_t& nosing : wire.nosings) {
    stairway.nosings.push_back({Eigen::Vector3d(nosing.left_m), Eigen::Vector3d(nosing.right_m)});
  }
  stairway.score = wire.score;
  return stairway;
}

rejection_t to_wire(const detect::Rejection& rejection) {
  rejection_t wire{};
  wire.reason = rejection.reason;
  wire.detail = rejection.detail;
  wire.num_figures = static_cast<std::int32_t>(rejection.figures.size());
  for (const auto& [name, value] : rejection.figures) {
    wire.figure_names.push_back(name);
    wire.figure_values.push_back(value);
  }
  return wire;
}

detect::Rejection from_wire(const rejection_t& wire) {
  detect::Rejection rejection{wire.reason, wire.detail, {}};
  for (std::size_t i = 0; i < wire.figure_names.size(); ++i) {
    rejection.figures.emplace_back(wire.figure_names[i], wire.figure_values[i]);
  }
  return rejection;
}

void put(const std::vector<DeviceHealth>& devices, health_t& wire) {
  wire.num_devices = static_cast<std::int32_t>(devices.size());
  for (const DeviceHealth& device : devices) {
    wire.device_names.push_back(device.name);
    wire.device_states.push_back(device.state);
    wire.device_reasons.push_back(device.reason);
    wire.device_ok.push_back(device.is_ok);
    wire.device_rate_hz.push_back(device.rate_hz);
    wire.device_age_s.push_back(device.data_age_s);
    wire.device_troubles.push_back(device.troubles);
  }
}

void put(const ClockHealth& clock, health_t& wire) {
  wire.clock_source = static_cast<std::int8_t>(clock.source);
  wire.clock_period_ms = clock.period_ms;
  wire.clock_latency_ms = clock.latency_ms;
  wire.clock_round_trip_ms = clock.round_trip_ms;
  wire.clock_bound_ms = clock.bound_ms;
  wire.clock_sync_residual_ms = clock.sync_residual_ms;
  wire.clock_delay_ms = clock.delay_ms;
  wire.clock_residual_ms = clock.residual_ms;
  wire.clock_drift_ppm = clock.drift_ppm;
  wire.clock_resets = clock.resets;
}

void put(const ResultHealth& result, health_t& wire) {
  wire.last_sweep = result.sweep;
  wire.last_sweep_age_s = result.sweep_age_s;
  wire.last_sweep_points = result.sweep_points;
  wire.last_sweep_flaws = result.sweep_flaws;
  wire.last_pass_stairways = result.stairways;
  wire.last_stairway_sweep = result.stairway_sweep;
  wire.last_stairway_age_s = result.stairway_age_s;
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
  auto wire = from_bytes<scan_t>(bytes);
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
  const auto wire = from_bytes<disk_t>(bytes);
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
  const auto wire = from_bytes<angles_t>(bytes);
  if (!wire) return tl::unexpected(wire.error());
  AnglesMessage message{wire->utime, wire->scan_stamp_ns, {}};
  message.samples.reserve(wire->stamps_ns.size());
  for (std::size_t i = 0; i < wire->stamps_ns.size(); ++i)
    message.samples.push_back({wire->stamps_ns[i], wire->angles_rad[i], wire->valid[i] != 0});
  return message;
}

Bytes encode(const StairwaysMessage& message) {
  stairways_t wire{};
  wire.utime = message.utime_us;
  wire.sweep_start_utime = message.sweep_start_utime_us;
  wire.sweep = message.sweep;
  wire.is_final = message.is_final;
  const auto& stairways = message.detection.stairways;
  wire.num_stairways = static_cast<std::int32_t>(stairways.size());
  for (std::size_t i = 0; i < stairways.size(); ++i) {
    const std::int64_t track_id = i < message.track_ids.size() ? message.track_ids[i] : 0;
    wire.stairways.push_back(to_wire(stairways[i], message.utime_us, track_id));
  }
  wire.num_rejected = static_cast<std::int32_t>(message.detection.rejected.size());
  for (const detect::Rejection& rejection : message.detection.rejected) wire.rejected.push_back(to_wire(rejection));
  return to_bytes(wire);
}

template <>
tl::expected<StairwaysMessage, MessageFault> decode<StairwaysMessage>(std::span<const std::uint8_t> bytes) {
  const auto wire = from_bytes<stairways_t>(bytes);
  if (!wire) return tl::unexpected(wire.error());
  StairwaysMessage message;
  message.utime_us = wire->utime;
  message.sweep_start_utime_us = wire->sweep_start_utime;
  message.sweep = wire->sweep;
  message.is_final = wire->is_final != 0;
  for (const stairway_t& entry : wire->stairways) {
    auto stairway = from_wire(entry);
    if (!stairway) return tl::unexpected(MessageFault::ImpossibleValue);
    message.detection.stairways.push_back(std::move(*stairway));
    message.track_ids.push_back(entry.track_id);
  }
  for (const rejection_t& entry : wire->rejected) message.detection.rejected.push_back(from_wire(entry));
  return message;
}

Bytes encode(const HealthMessage& message) {
  health_t wire{};
  wire.utime = message.utime_us;
  wire.state = message.state;
  wire.num_reasons = static_cast<std::int32_t>(message.reasons.size());
  wire.reasons = message.reasons;
  wire.sweep = message.sweep;
  wire.sweep_progress = message.sweep_progress;
  wire.scan_rate_hz = message.scan_rate_hz;
  wire.disk_rate_hz = message.disk_rate_hz;
  wire.points = message.points;
  wire.num_drops = static_cast<std::int32_t>(message.drops.size());
  for (const auto& [name, count] : message.drops) {
    wire.drop_names.push_back(name);
    wire.drop_counts.push_back(count);
  }
  put(message.devices, wire);
  put(message.clock, wire);
  wire.num_stages = static_cast<std::int32_t>(message.stages.size());
  for (const StageHealth& stage : message.stages) {
    wire.stage_names.push_back(stage.name);
    wire.stage_p50_ms.push_back(stage.p50_ms);
    wire.stage_p95_ms.push_back(stage.p95_ms);
  }
  put(message.result, wire);
  return to_bytes(wire);
}

template <>
tl::expected<HealthMessage, MessageFault> decode<HealthMessage>(std::span<const std::uint8_t> bytes) {
  auto wire = from_bytes<health_t>(bytes);
  if (!wire) return tl::unexpected(wire.error());
  const auto clock_source = enumerator(wire->clock_source, drivers::ClockSource::SyncPulse);
  if (!clock_source) return tl::unexpected(MessageFault::ImpossibleValue);
  HealthMessage message;
  message.utime_us = wire->utime;
  message.state = wire->state;
  message.reasons = std::move(wire->reasons);
  message.sweep = wire->sweep;
  message.sweep_progress = wire->sweep_progress;
  message.scan_rate_hz = wire->scan_rate_hz;
  message.disk_rate_hz = wire->disk_rate_hz;
  message.points = wire->points;
  for (std::size_t i = 0; i < wire->drop_names.size(); ++i) {
    message.drops.emplace_back(wire->drop_names[i], wire->drop_counts[i]);
  }
  for (std::size_t i = 0; i < wire->device_names.size(); ++i) {
    message.devices.push_back({wire->device_names[i], wire->device_states[i], wire->device_reasons[i],
                               wire->device_ok[i] != 0, wire->device_rate_hz[i], wire->device_age_s[i],
                               wire->device_troubles[i]});
  }
  message.clock = {*clock_source,          wire->clock_period_ms,
                   wire->clock_latency_ms, wire->clock_round_trip_ms,
                   wire->clock_bound_ms,   wire->clock_sync_residual_ms,
                   wire->clock_delay_ms,   wire->clock_residual_ms,
                   wire->clock_drift_ppm,  wire->clock_resets};
  for (std::size_t i = 0; i < wire->stage_names.size(); ++i) {
    message.stages.push_back({wire->stage_names[i], wire->stage_p50_ms[i], wire->stage_p95_ms[i]});
  }
  message.result = {wire->last_sweep,         wire->last_sweep_age_s,    wire->last_sweep_points,
                    wire->last_sweep_flaws,   wire->last_pass_stairways, wire->last_stairway_sweep,
                    wire->last_stairway_age_s};
  return message;
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
  const auto wire = from_bytes<settings_t>(bytes);
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
