// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <numbers>

#include "drivers/canopen/motor_session.hpp"
#include "tests/drivers/motor_bench.hpp"

namespace stairway::drivers {
namespace {

// Brings a bench into a state, in which it is then told to stop.
struct StopCase {
  const char* name;
  std::function<void(MotorBench&)> prepare;
};

TEST(MotorStop, the_stop_sequence_ends_with_the_drive_off_from_every_state) {
  const auto turning = [](MotorBench& bench) {
    bench.session.set_speed(kSpeed_rad_s);
    bench.run(5.0);
  };
  const StopCase cases[] = {
      {"before anything", [](MotorBench&) {}},
      {"searching", [](MotorBench& bench) { bench.run(0.02); }},
      {"configuring", [](MotorBench& bench) { bench.run(0.08); }},
      {"enabling", [](MotorBench& bench) { bench.run_until(MotorState::Enabling, 2.0); }},
      {"accelerating",
       [](MotorBench& bench) {
         bench.session.set_speed(3.0);
         bench.run(2.0);
       }},
      {"running", turning},
      {"fault reaction",
       [&](MotorBench& bench) {
         turning(bench);
         bench.drive.raise_fault(0x2310, bench.now_ns);
       }},
      {"faulted",
       [&](MotorBench& bench) {
         turning(bench);
         bench.drive.faults().is_fault_stuck = true;
         bench.drive.raise_fault(0x2310, bench.now_ns);
         bench.run(2.0);
       }},
      {"torque off",
       [&](MotorBench& bench) {
         turning(bench);
         bench.drive.faults().is_torque_off = true;
         bench.run(0.1);
       }},
      {"backoff",
       [](MotorBench& bench) {
         bench.drive.faults().aborts[objects::kMode] = sdo_abort::kDeviceState;
         bench.run_until(MotorState::Backoff, 2.0);
       }},
  };
  for (const bool is_quick : {false, true}) {
    for (const StopCase& one : cases) {
      SCOPED_TRACE(one.name);
      SCOPED_TRACE(is_quick);
      MotorBench bench;
      one.prepare(bench);
      if (is_quick) {
        bench.session.quick_stop();
      } else {
        bench.session.stop();
      }
      EXPECT_TRUE(bench.run_until(MotorState::Stopped, 5.0));
      EXPECT_TRUE(bench.session.has_stopped_safely());
      bench.run(0.01);
      EXPECT_TRUE(is_off(bench.drive.state())) << to_string(bench.drive.state());
      EXPECT_EQ(bench.drive.disk_speed_rad_s(), 0.0);
      EXPECT_EQ(bench.session.deadline(), std::numeric_limits<HostStamp>::max());
    }
  }
}

TEST(MotorStop, the_stop_sequence_ends_in_time_without_a_drive_or_a_bus) {
  const StopCase cases[] = {
      {"silent", [](MotorBench& bench) { bench.drive.faults().is_silent = true; }},
      {"cut", [](MotorBench& bench) { bench.bus.set_unheard(true, bench.now_ns); }},
      {"down", [](MotorBench& bench) { bench.bus.set_link(false, bench.now_ns); }},
      {"removed", [](MotorBench& bench) { bench.bus.set_removed(true); }},
  };
  for (const StopCase& one : cases) {
    SCOPED_TRACE(one.name);
    RunningBench bench;
    one.prepare(bench);
    bench.session.stop();
    EXPECT_TRUE(bench.run_until(MotorState::Stopped, 1.0));
    EXPECT_FALSE(bench.session.has_seen_standstill());
    bench.run(3.0);
    EXPECT_EQ(bench.drive.disk_speed_rad_s(), 0.0);  // by its watch over this host
  }
}

TEST(MotorStop, a_disk_that_does_not_slow_down_is_switched_off_after_the_time_out) {
  RunningBench bench;
  bench.drive.faults().ramp_share = 0.0;
  bench.session.stop();
  ASSERT_TRUE(bench.run_until(MotorState::Stopped, 4.0));
  EXPECT_FALSE(bench.session.has_seen_standstill());
  EXPECT_EQ(bench.drive.state(), DriveState::SwitchOnDisabled);
  EXPECT_EQ(bench.count(MotorTrouble::StateTimeout), 1U);
}

TEST(MotorStop, a_drive_that_does_not_go_off_keeps_its_watch_over_this_host) {
  RunningBench bench;
  bench.drive.faults().is_local = true;
  bench.session.stop();
  ASSERT_TRUE(bench.run_until(MotorState::Stopped, 5.0));
  EXPECT_FALSE(bench.session.has_stopped_safely());
  EXPECT_EQ(bench.drive.state(), DriveState::Enabled);
  EXPECT_NE(bench.detail(MotorTrouble::StateTimeout).find("did not say that it is off"), std::string::npos);
  bench.run(1.0);
  EXPECT_NE(bench.drive.state(), DriveState::Enabled);
}

TEST(MotorStop, a_quick_stop_brakes_faster_than_a_stop) {
  const auto braking_time = [](bool is_quick) {
    RunningBench bench;
    bench.session.set_speed(2.0);
    EXPECT_TRUE(bench.run_until_speed(2.0, 10.0));
    if (is_quick) bench.session.quick_stop();
    if (!is_quick) bench.session.stop();
    const HostStamp begin_ns = bench.now_ns;
    EXPECT_TRUE(bench.run_until_speed(0.0, 10.0));
    return 1e-9 * static_cast<double>(bench.now_ns - begin_ns);
  };
  EXPECT_NEAR(braking_time(false), 2.0 / (std::numbers::pi / 3), 0.05);
  EXPECT_NEAR(braking_time(true), 2.0 / (std::numbers::pi / 0.6), 0.05);
}

TEST(MotorStop, starts_again_after_a_stop) {
  RunningBench bench;
  bench.session.stop();
  ASSERT_TRUE(bench.run_until(MotorState::Stopped, 3.0));
  bench.run(2.0);
  EXPECT_EQ(bench.session.state(), MotorState::Stopped);
  bench.session.start();
  EXPECT_TRUE(bench.recovers(5.0));
  EXPECT_EQ(bench.all_troubles(), 0U);
}

}  // namespace
}  // namespace stairway::drivers
