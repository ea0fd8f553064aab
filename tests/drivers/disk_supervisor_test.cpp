// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "drivers/disk/disk_supervisor.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <variant>

namespace stairway::drivers {
namespace {

constexpr HostStamp kStep_ns = 25'000'000;

const DiskUnits kUnits{.counts_per_turn = 200'000,
                       .velocity_units_per_turn_per_s = 200'000,
                       .is_drive_reversed = false,
                       .encoder_counts_per_turn = 4096,
                       .is_encoder_reversed = false,
                       .acceleration_rad_s2 = 1.0};

/// A disk whose drive follows the wanted speed by a ramp, and what it and the encoder tell.
class Rig {
 public:
  explicit Rig(const DiskOptions& options = {}) : supervisor(options, kUnits) {}

  void run(double seconds) {
    const HostStamp end_ns = now_ns + std::llround(1e9 * seconds);
    for (; now_ns < end_ns; now_ns += kStep_ns) {
      const double step_s = 1e-9 * kStep_ns;
      const double wanted = motor == MotorState::Running ? supervisor.wanted_speed_rad_s() * obedience : 0.0;
      speed += std::clamp(wanted - speed, -step_s, step_s);
      drive_angle += drive_factor * (speed + push) * step_s;
      encoder_angle += encoder_factor * (speed + push) * step_s;
      if (is_drive_telling) supervisor.on_feedback({now_ns, drive_angle, drive_factor * (speed + push), speed != 0.0});
      if (is_encoder_telling) {
        const AngleSample sample{now_ns, encoder_zero + encoder_angle, is_indexed};
        supervisor.on_angles({&sample, 1});
      }
      for (const DiskEvent& event : supervisor.on_time(now_ns)) {
        if (const auto* trouble = std::get_if<DiskTroubleEvent>(&event)) troubles.push_back(*trouble);
        if (const auto* state = std::get_if<DiskStateEvent>(&event)) states.push_back(*state);
      }
    }
  }
  void set_motor(MotorState state) {
    motor = state;
    supervisor.on_motor(state, now_ns);
  }
  void make_ready() {
    supervisor.on_scanner(true, now_ns);
    set_motor(MotorState::Running);
    supervisor.on_encoder(EncoderState::Unindexed, now_ns);
  }

  DiskSupervisor supervisor;
  HostStamp now_ns = 0;
  MotorState motor = MotorState::Searching;
  double speed = 0.0, push = 0.0, drive_angle = 0.0, encoder_angle = 0.0;
  double obedience = 1.0, drive_factor = 1.0, encoder_factor = 1.0, encoder_zero = 0.0;
  bool is_drive_telling = true, is_encoder_telling = true, is_indexed = true;
  std::vector<DiskTroubleEvent> troubles;
  std::vector<DiskStateEvent> states;
};

std::vector<DiskState> visited(const Rig& rig) {
  std::vector<DiskState> states;
  for (const DiskStateEvent& event : rig.states) {
    if (states.empty() || states.back() != event.state) states.push_back(event.state);
  }
  return states;
}

const double kFull_rad_s = DiskOptions{}.speed_rad_s();

TEST(DiskSupervisor, turns_after_a_check_as_soon_as_all_devices_are_ready) {
  for (const double period_s : {35.0, -35.0}) {
    SCOPED_TRACE(period_s);
    DiskOptions options;
    options.period_s = period_s;
    Rig rig(options);
    rig.run(1.0);
    EXPECT_EQ(rig.supervisor.wanted_speed_rad_s(), 0.0);
    rig.make_ready();
    rig.run(1.0);
    EXPECT_DOUBLE_EQ(rig.supervisor.wanted_speed_rad_s(), std::copysign(options.check_speed_rad_s, period_s));
    rig.run(3.0);
    EXPECT_DOUBLE_EQ(rig.supervisor.wanted_speed_rad_s(), std::copysign(kFull_rad_s, period_s));
    rig.run(60.0);
    EXPECT_EQ(visited(rig), (std::vector{DiskState::Checking, DiskState::Turning}));
    EXPECT_TRUE(rig.troubles.empty());
  }
}

TEST(DiskSupervisor, no_device_may_be_missing_at_the_start) {
  for (int missing = 0; missing < 3; ++missing) {
    SCOPED_TRACE(missing);
    Rig rig;
    if (missing != 0) rig.supervisor.on_scanner(true, 0);
    if (missing != 1) rig.set_motor(MotorState::Running);
    if (missing != 2) rig.supervisor.on_encoder(EncoderState::Unindexed, 0);
    rig.run(10.0);
    EXPECT_EQ(rig.supervisor.wanted_speed_rad_s(), 0.0);
    rig.make_ready();
    rig.run(10.0);
    EXPECT_DOUBLE_EQ(rig.supervisor.wanted_speed_rad_s(), kFull_rad_s);
  }
}

TEST(DiskSupervisor, a_disk_slower_than_the_check_is_checked_at_its_speed) {
  DiskOptions options;
  options.period_s = 300.0;
  Rig rig(options);
  rig.make_ready();
  rig.run(1.0);
  EXPECT_DOUBLE_EQ(rig.supervisor.wanted_speed_rad_s(), options.speed_rad_s());
}

TEST(DiskSupervisor, failed_check_stops_the_disk_says_why_and_is_tried_again_after_a_pause) {
  Rig rig;
  rig.encoder_factor = 4.0;
  rig.make_ready();
  rig.run(10.0);
  EXPECT_EQ(rig.supervisor.wanted_speed_rad_s(), 0.0);
  EXPECT_EQ(rig.supervisor.state(), DiskState::Paused);
  ASSERT_EQ(rig.troubles.size(), 1u);
  EXPECT_EQ(rig.troubles.front().trouble, DiskTrouble::Mismatch);
  ASSERT_TRUE(rig.states.back().problem);
  EXPECT_NE(rig.states.back().problem->detail.find("would fit"), std::string::npos);
  rig.run(30.0);
  EXPECT_EQ(rig.troubles.size(), 2u);
  EXPECT_EQ(rig.supervisor.counters().count(DiskTrouble::Mismatch), 2u);

  rig.encoder_factor = 1.0;
  rig.run(40.0);
  EXPECT_EQ(rig.supervisor.state(), DiskState::Turning);
  EXPECT_FALSE(rig.states.back().problem);
}

TEST(DiskSupervisor, new_zeros_in_the_middle_of_the_check_do_no_harm) {
  Rig rig;
  rig.is_indexed = false;
  rig.make_ready();
  rig.run(1.5);
  rig.encoder_zero = -2.0;
  rig.is_indexed = true;
  rig.run(0.5);
  rig.encoder_zero = 1.0;
  rig.supervisor.on_encoder(EncoderState::Indexed, rig.now_ns);
  rig.run(5.0);
  EXPECT_EQ(rig.supervisor.state(), DiskState::Turning);
  EXPECT_TRUE(rig.troubles.empty());
}

TEST(DiskSupervisor, disk_goes_on_for_a_while_without_scans_and_then_rests) {
  DiskOptions options;
  options.idle_after_s = 20.0;
  Rig rig(options);
  rig.make_ready();
  rig.run(10.0);
  rig.supervisor.on_scanner(false, rig.now_ns);
  rig.run(19.0);
  EXPECT_EQ(rig.supervisor.state(), DiskState::Turning);
  rig.run(2.0);
  EXPECT_EQ(rig.supervisor.state(), DiskState::Resting);
  EXPECT_EQ(rig.supervisor.wanted_speed_rad_s(), 0.0);
  rig.supervisor.on_scanner(true, rig.now_ns);
  rig.run(0.1);
  EXPECT_EQ(rig.supervisor.state(), DiskState::Turning) << "what was checked needs no further check";
  EXPECT_TRUE(rig.troubles.empty());
}

TEST(DiskSupervisor, encoder_that_is_gone_is_no_trouble_of_the_disk_and_ends_no_check) {
  Rig rig;
  rig.make_ready();
  rig.run(0.5);
  rig.supervisor.on_encoder(EncoderState::Absent, rig.now_ns);
  rig.is_encoder_telling = false;
  rig.run(10.0);
  EXPECT_EQ(rig.supervisor.state(), DiskState::Checking);
  rig.supervisor.on_encoder(EncoderState::Unindexed, rig.now_ns);
  rig.is_encoder_telling = true;
  rig.run(5.0);
  EXPECT_EQ(rig.supervisor.state(), DiskState::Turning);
  rig.supervisor.on_encoder(EncoderState::Absent, rig.now_ns);
  rig.is_encoder_telling = false;
  rig.run(10.0);
  EXPECT_EQ(rig.supervisor.state(), DiskState::Turning);
  EXPECT_TRUE(rig.troubles.empty());
}

TEST(DiskSupervisor, fault_of_the_drive_leaves_the_wanted_speed_and_a_new_set_up_is_checked) {
  Rig rig;
  rig.make_ready();
  rig.run(10.0);
  rig.set_motor(MotorState::Faulted);
  rig.run(5.0);
  EXPECT_DOUBLE_EQ(rig.supervisor.wanted_speed_rad_s(), kFull_rad_s);
  rig.set_motor(MotorState::Running);
  rig.run(10.0);
  EXPECT_EQ(rig.supervisor.state(), DiskState::Turning);

  rig.set_motor(MotorState::Searching);
  rig.run(5.0);
  EXPECT_EQ(rig.supervisor.wanted_speed_rad_s(), 0.0);
  rig.set_motor(MotorState::Running);
  rig.run(1.0);
  EXPECT_EQ(rig.supervisor.state(), DiskState::Checking);
  rig.run(5.0);
  EXPECT_EQ(rig.supervisor.state(), DiskState::Turning);
  EXPECT_TRUE(rig.troubles.empty());
}

TEST(DiskSupervisor, troubles_of_a_turning_disk_are_told_while_they_last) {
  const struct {
    const char* what;
    DiskTrouble trouble;
    void (*begin)(Rig&);
    void (*end)(Rig&);
    bool is_stopped;
  } cases[] = {
      {"encoder slips", DiskTrouble::Slip, [](Rig& rig) { rig.encoder_factor = 0.8; },
       [](Rig& rig) { rig.encoder_factor = 1.0; }, false},
      {"encoder dead", DiskTrouble::EncoderSilent, [](Rig& rig) { rig.is_encoder_telling = false; },
       [](Rig& rig) { rig.is_encoder_telling = true; }, false},
      {"encoder stuck", DiskTrouble::EncoderSilent, [](Rig& rig) { rig.encoder_factor = 0.0; },
       [](Rig& rig) { rig.encoder_factor = 1.0; }, false},
      {"drive says nothing", DiskTrouble::DriveSilent, [](Rig& rig) { rig.is_drive_telling = false; },
       [](Rig& rig) { rig.is_drive_telling = true; }, false},
      {"slow", DiskTrouble::NotReached, [](Rig& rig) { rig.obedience = 0.5; }, [](Rig& rig) { rig.obedience = 1.0; },
       false},
      {"blocked", DiskTrouble::NotTurning, [](Rig& rig) { rig.obedience = 0.0; }, [](Rig& rig) { rig.obedience = 1.0; },
       false},
      {"encoder backwards", DiskTrouble::Reversed, [](Rig& rig) { rig.encoder_factor = -1.0; },
       [](Rig& rig) { rig.encoder_factor = 1.0; }, true},
  };
  for (const auto& test : cases) {
    SCOPED_TRACE(test.what);
    Rig rig;
    rig.make_ready();
    rig.run(10.0);
    test.begin(rig);
    rig.run(9.0);
    ASSERT_FALSE(rig.troubles.empty());
    EXPECT_EQ(rig.troubles.back().trouble, test.trouble) << rig.troubles.back().detail;
    ASSERT_TRUE(rig.states.back().problem);
    EXPECT_EQ(rig.supervisor.wanted_speed_rad_s() == 0.0, test.is_stopped);
    test.end(rig);
    rig.run(60.0);
    EXPECT_FALSE(rig.states.back().problem);
    EXPECT_EQ(rig.supervisor.state(), DiskState::Turning);
  }
}

TEST(DiskSupervisor, a_disk_that_moves_unasked_is_told) {
  Rig rig;
  rig.set_motor(MotorState::Running);
  rig.push = 0.1;
  rig.run(10.0);
  ASSERT_FALSE(rig.troubles.empty());
  EXPECT_EQ(rig.troubles.back().trouble, DiskTrouble::Unasked);
  rig.push = 0.0;
  rig.run(10.0);
  EXPECT_FALSE(rig.states.back().problem);
}

TEST(DiskSupervisor, without_an_encoder_the_drive_alone_is_checked) {
  DiskOptions options;
  options.angle_source = AngleSource::Drive;
  Rig rig(options);
  rig.is_encoder_telling = false;
  rig.supervisor.on_scanner(true, 0);
  rig.set_motor(MotorState::Running);
  rig.run(20.0);
  EXPECT_EQ(rig.supervisor.state(), DiskState::Turning);
  EXPECT_TRUE(rig.troubles.empty());
}

TEST(DiskOptions, odd_values_are_named) {
  EXPECT_EQ(DiskOptions{}.problem(), "");
  for (const double period_s : {0.0, 0.5, -0.99, 1000.0, std::nan("")}) {
    DiskOptions options;
    options.period_s = period_s;
    EXPECT_NE(options.problem().find("period"), std::string::npos) << period_s;
  }
}

}  // namespace
}  // namespace stairway::drivers
