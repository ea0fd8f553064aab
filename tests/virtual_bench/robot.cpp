// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/virtual_bench/robot.hpp"

#include <cmath>
#include <utility>

#include "drivers/host_clock.hpp"
#include "tools/sim/scanner_model.hpp"

namespace stairway::bench {
namespace {

// The index is at 0.
constexpr double kStartAngle_rad = -0.5;

drivers::HostStamp beam_stamp_ns(drivers::HostStamp turn_start_ns, int beam) {
  const double turns = static_cast<double>(sim::kStepsBeforeFirstBeam + beam) / sim::kStepsPerTurn;
  return turn_start_ns + std::llround(1e9 * sim::kTurnPeriod_s * turns);
}

template <class Options>
Options switched_on_now() {
  Options options;
  options.start_ns = now_ns();
  return options;
}

}  // namespace

drivers::HostStamp now_ns() { return drivers::monotonic_now_ns(); }

Robot::Robot(ScanTable what_is_seen)
    : table(std::move(what_is_seen)),
      motion(now_ns(), kStartAngle_rad, 0.0),
      drive(switched_on_now<sim::FakeDriveOptions>()),
      scanner(switched_on_now<sim::FakeUtm30lxOptions>(),
              [this](std::uint64_t, drivers::HostStamp start_ns, std::span<std::uint32_t> values) {
                drive.advance(now_ns());
                table.look_up(motion.angle_at(beam_stamp_ns(start_ns, 0)),
                              motion.angle_at(beam_stamp_ns(start_ns, sim::kBeams - 1)), values);
              }) {
  drive.listen([this](drivers::HostStamp stamp_ns, double speed_rad_s) { motion.set_speed(stamp_ns, speed_rad_s); });
}

}  // namespace stairway::bench
