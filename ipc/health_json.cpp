// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "ipc/health_json.hpp"

#include <nlohmann/json.hpp>

namespace stairway::ipc {
namespace {

using Json = nlohmann::ordered_json;

/// Negative ages, numbers and bounds mean that there is none.
template <class Number>
Json unless_negative(Number value) {
  return value < 0 ? Json(nullptr) : Json(value);
}

Json as_json(const DeviceHealth& device) {
  return {{"name", device.name},        {"state", device.state},     {"ok", device.is_ok},
          {"reason", device.reason},    {"rate_hz", device.rate_hz}, {"age_s", unless_negative(device.data_age_s)},
          {"troubles", device.troubles}};
}

Json as_json(const ClockHealth& clock) {
  return {{"source", to_string(clock.source)},
          {"period_ms", clock.period_ms},
          {"latency_ms", clock.latency_ms},
          {"round_trip_ms", clock.round_trip_ms},
          {"bound_ms", unless_negative(clock.bound_ms)},
          {"sync_residual_ms", clock.sync_residual_ms},
          {"delay_ms", clock.delay_ms},
          {"residual_ms", clock.residual_ms},
          {"drift_ppm", clock.drift_ppm},
          {"resets", clock.resets}};
}

Json as_json(const ResultHealth& result) {
  return {{"sweep", unless_negative(result.sweep)},
          {"sweep_age_s", unless_negative(result.sweep_age_s)},
          {"sweep_points", result.sweep_points},
          {"sweep_flaws", result.sweep_flaws},
          {"stairways", unless_negative(result.stairways)},
          {"stairway_sweep", unless_negative(result.stairway_sweep)},
          {"stairway_age_s", unless_negative(result.stairway_age_s)}};
}

}  // namespace

std::string health_json(const HealthMessage& health) {
  Json drops = Json::object(), devices = Json::array(), stages = Json::array();
  for (const auto& [name, count] : health.drops) drops[name] = count;
  for (const DeviceHealth& device : health.devices) devices.push_back(as_json(device));
  for (const StageHealth& stage : health.stages)
    stages.push_back({{"name", stage.name}, {"p50_ms", stage.p50_ms}, {"p95_ms", stage.p95_ms}});
  const Json object{{"utime", health.utime_us},
                    {"state", health.state},
                    {"reasons", health.reasons},
                    {"sweep", health.sweep},
                    {"sweep_progress", health.sweep_progress},
                    {"scan_rate", health.scan_rate_hz},
                    {"disk_rate", health.disk_rate_hz},
                    {"points", health.points},
                    {"drops", std::move(drops)},
                    {"devices", std::move(devices)},
                    {"clock", as_json(health.clock)},
                    {"stages", std::move(stages)},
                    {"last", as_json(health.result)}};
  return object.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace stairway::ipc
