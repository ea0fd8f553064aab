// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include <stairway/health_t.hpp>

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

static_assert(health_t::CLOCK_TIME_ADJUSTMENT == static_cast<int>(drivers::ClockSource::TimeAdjustment));
static_assert(health_t::CLOCK_SYNC_PULSE == static_cast<int>(drivers::ClockSource::SyncPulse));

bool is_health(std::span<const std::uint8_t> bytes) {
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
  auto wire = from_bytes<health_t>(bytes, is_health);
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

}  // namespace stairway::ipc
