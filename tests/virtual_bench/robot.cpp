// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/virtual_bench/robot.hpp"

#include <chrono>
#include <cmath>
#include <utility>

#include "tools/sim/scanner_model.hpp"

namespace stairway::bench {
namespace {

// The index is at 0.
constexpr double kStartAngle_rad = 1.0;

drivers::HostStamp beam_stamp_ns(drivers::HostStamp turn_start_ns, int beam) {
  const double turns = static_cast<double>(sim::kStepsBeforeFirstBeam + beam) / sim::kStepsPerTurn;
  return turn_start_ns + std::llround(1e9 * sim::kTurnPeriod_s * turns);
}

sim::FakeUtm30lxOptions scanner_options(drivers::HostStamp start_ns) {
  sim::FakeUtm30lxOptions options;
  options.start_ns = start_ns;
  return options;
}

}  // namespace

drivers::HostStamp now_ns() {
  return std::chrono::steady_clock::now().time_since_epoch() / std::chrono::nanoseconds(1);
}

Robot::Robot(ScanTable what_is_seen)
    : table(std::move(what_is_seen)),
      motion(now_ns(), kStartAngle_rad, 0.0),
      scanner(scanner_options(now_ns()),
              [this](std::uint64_t, drivers::HostStamp start_ns, std::span<std::uint32_t> values) {
                table.look_up(motion.angle_at(beam_stamp_ns(start_ns, 0)),
                              motion.angle_at(beam_stamp_ns(start_ns, sim::kBeams - 1)), values);
              }) {}

}  // namespace stairway::bench
