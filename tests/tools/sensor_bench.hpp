// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "drivers/scip/scip_session.hpp"
#include "tools/sim/fake_utm30lx.hpp"

namespace stairway::sim {

/// A session and the simulated sensor, stepped together through simulated time.
class SensorBench {
 public:
  static constexpr std::uint32_t kRange_mm = 2345;

  explicit SensorBench(const FakeUtm30lxOptions& sensor_options = {}, const drivers::ScipOptions& options = {})
      : sensor(sensor_options,
               [](auto, auto, std::span<std::uint32_t> values) { std::ranges::fill(values, kRange_mm); }),
        session(options) {}

  void run(double seconds) {
    const drivers::HostStamp end_ns = now_ns + std::llround(seconds * 1e9);
    while (now_ns < end_ns) {
      now_ns = std::min({end_ns, std::max(now_ns, session.deadline()), std::max(now_ns, sensor.next_due_ns())});
      give_pulses();
      if (const auto chunk = sensor.take(now_ns)) take(session.on_bytes(chunk->bytes, chunk->arrival_ns));
      take(session.on_time(now_ns));
      if (const std::string output = session.take_output(); !output.empty()) sensor.receive(output, now_ns);
    }
  }

  /// Seconds until `wanted` more scans were decoded; negative when that took more than `limit_s`.
  double time_to_scans(std::uint64_t wanted, double limit_s) {
    const std::uint64_t enough = session.counters().scans + wanted;
    const drivers::HostStamp start_ns = now_ns;
    while (session.counters().scans < enough) {
      if (static_cast<double>(now_ns - start_ns) > 1e9 * limit_s) return -1.0;
      run(0.025);
    }
    return 1e-9 * static_cast<double>(now_ns - start_ns);
  }

  std::uint64_t count(drivers::ScipTrouble trouble) const { return session.counters().count(trouble); }

  FakeUtm30lx sensor;
  drivers::ScipSession session;
  drivers::HostStamp now_ns = 10'000'000'000;
  std::vector<drivers::LaserScan> scans;
  std::uint64_t wrong_scans = 0;
  std::optional<drivers::HostStamp> pulse_phase_ns;  ///< of a sync pulse behind the begin of each turn

 private:
  void give_pulses() {
    constexpr drivers::HostStamp kTurn_ns = 25'000'000;
    const drivers::HostStamp phase_ns = pulse_phase_ns.value_or(0);
    for (; next_turn_ns_ + phase_ns <= now_ns; next_turn_ns_ += kTurn_ns) {
      if (pulse_phase_ns) session.on_sync_pulse(next_turn_ns_ + phase_ns);
    }
  }

  void take(std::vector<drivers::ScipEvent> events) {
    for (drivers::ScipEvent& event : events) {
      auto* scan = std::get_if<drivers::LaserScan>(&event);
      if (!scan) continue;
      const auto is_right = [](float range_m) { return std::abs(range_m - 1e-3F * kRange_mm) < 1e-6F; };
      if (!std::ranges::all_of(scan->ranges_m, is_right)) ++wrong_scans;
      scans.push_back(std::move(*scan));
    }
  }

  drivers::HostStamp next_turn_ns_ = 0;
};

}  // namespace stairway::sim
