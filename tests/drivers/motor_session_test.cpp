// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "drivers/canopen/motor_session.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "tests/drivers/motor_bench.hpp"

namespace stairway::drivers {
namespace {

TEST(MotorSession, finds_sets_up_and_enables_a_drive_and_follows_the_wanted_speed) {
  MotorBench bench;
  bench.session.set_speed(kSpeed_rad_s);
  ASSERT_TRUE(bench.run_until(MotorState::Running, 2.0)) << bench.detail(MotorTrouble::SdoAbort);
  EXPECT_TRUE(bench.run_until_speed(kSpeed_rad_s, 1.0));
  EXPECT_EQ(bench.states(),
            (std::vector{MotorState::Searching, MotorState::Configuring, MotorState::Enabling, MotorState::Running}));
  bench.run(10.0);
  EXPECT_EQ(bench.all_troubles(), 0U);
  ASSERT_EQ(bench.all<DriveInfo>().size(), 1U);
  EXPECT_EQ(bench.all<DriveInfo>().front().name, "Simulated disk drive");
  EXPECT_EQ(bench.all<DriveInfo>().front().vendor, 0x1a7U);
  EXPECT_EQ(bench.session.counters().dropped_frames, 0U);
}

TEST(MotorSession, tells_angle_and_speed_at_every_sync) {
  MotorBench bench;
  bench.session.set_speed(kSpeed_rad_s);
  bench.run(5.0);
  bench.events.clear();
  bench.run(10.0);
  const auto feedbacks = bench.all<DriveFeedback>();
  EXPECT_NEAR(static_cast<double>(feedbacks.size()), 1000.0, 1.0);
  for (std::size_t i = 1; i < feedbacks.size(); ++i) {
    EXPECT_EQ(feedbacks[i].stamp_ns - feedbacks[i - 1].stamp_ns, 10 * kMs);
    EXPECT_NEAR(feedbacks[i].angle_rad - feedbacks[i - 1].angle_rad, kSpeed_rad_s * 0.01, 7e-5);
    EXPECT_NEAR(feedbacks[i].speed_rad_s, kSpeed_rad_s, 1e-4);
    EXPECT_TRUE(feedbacks[i].is_moving);
  }
}

TEST(MotorSession, works_with_polls_every_50_ms) {
  MotorBench bench;
  bench.poll_ms = 50;
  bench.session.set_speed(kSpeed_rad_s);
  ASSERT_TRUE(bench.run_until(MotorState::Running, 5.0));
  bench.run(20.0);
  EXPECT_EQ(bench.all_troubles(), 0U);
  EXPECT_NEAR(bench.drive.disk_speed_rad_s(), kSpeed_rad_s, 1e-4);
  EXPECT_NEAR(static_cast<double>(bench.all<DriveFeedback>().size()), 20.0 * 20, 10.0);
}

TEST(MotorSession, begins_again_when_asked_to_while_it_stops) {
  MotorBench bench;
  bench.session.set_speed(0.5);
  ASSERT_TRUE(bench.run_until_speed(0.5, 10.0));
  bench.session.stop();
  bench.run(0.1);
  ASSERT_EQ(bench.session.state(), MotorState::Stopping);
  bench.session.start();
  bench.poll();
  EXPECT_GT(bench.session.deadline(), bench.now_ns) << "waiting is no reason to be called without a pause";
  ASSERT_TRUE(bench.run_until(MotorState::Searching, 10.0));
  EXPECT_EQ(bench.drive.disk_speed_rad_s(), 0.0) << "the stop is not cut short";
  EXPECT_TRUE(bench.run_until_speed(0.5, 10.0));
}

TEST(MotorSession, stops_the_disk_and_switches_the_drive_off) {
  MotorBench bench;
  bench.session.set_speed(kSpeed_rad_s);
  bench.run(5.0);
  bench.session.stop();
  ASSERT_TRUE(bench.run_until(MotorState::Stopped, 3.0));
  EXPECT_TRUE(bench.session.has_stopped_safely());
  EXPECT_EQ(bench.drive.disk_speed_rad_s(), 0.0);
  EXPECT_EQ(bench.drive.state(), DriveState::SwitchOnDisabled);
  bench.run(0.01);
  EXPECT_EQ(bench.drive.nmt_state(), NmtState::PreOperational);
  EXPECT_EQ(bench.all_troubles(), 0U);
  bench.run(5.0);  // without this host's heartbeat
  EXPECT_EQ(bench.drive.state(), DriveState::SwitchOnDisabled);
}

}  // namespace
}  // namespace stairway::drivers
