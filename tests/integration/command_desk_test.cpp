// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "tools/stairwayd/command_desk.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

namespace stairway::daemon {
namespace {

using drivers::DiskMode;
using ipc::CommandAction;
using ipc::CommandResult;

constexpr std::int64_t kNow_us = 1'700'000'000'000'000;
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

/// Keeps the orders.
class ObedientSource final : public MeasurementSource {
 public:
  std::vector<SourceEvent> read(std::chrono::milliseconds) override { return {}; }
  std::string order(const DiskOrder& order) override {
    if (refusal.empty()) orders.push_back(order);
    return refusal;
  }
  void stop() override {}
  std::int64_t utime_us(drivers::HostStamp stamp_ns) const override { return stamp_ns / 1000; }

  std::string refusal;
  std::vector<DiskOrder> orders;
};

scan::Sweep sweep(std::uint64_t number, double covered_rad, scan::SweepEnd end = scan::SweepEnd::FullTurn) {
  scan::Sweep sweep;
  sweep.number = number;
  sweep.statistics.covered_angle_rad = covered_rad;
  sweep.statistics.end = end;
  return sweep;
}

constexpr double kTurn_rad = 2.0 * std::numbers::pi;

class CommandDeskTest : public testing::Test {
 protected:
  ipc::CommandAckMessage give(CommandAction action, double speed_rad_s = 0.0, std::int64_t utime_us = kNow_us) {
    desk.receive({utime_us, ++id, action, speed_rad_s});
    return desk.obey(source, kNow_us).at(0);
  }

  ObedientSource source;
  CommandDesk desk{config::Settings{}};
  std::int64_t id = 0;
};

TEST_F(CommandDeskTest, stop_and_start_become_orders_and_are_answered) {
  const auto stopped = give(CommandAction::Stop);
  EXPECT_EQ(stopped.id, 1);
  EXPECT_EQ(stopped.utime_us, kNow_us);
  EXPECT_EQ(stopped.result, CommandResult::Accepted);
  EXPECT_EQ(stopped.mode, DiskMode::Idle);
  EXPECT_EQ(stopped.text, "idle: the disk rests, the motor is off");
  EXPECT_FALSE(source.orders.back().is_turning);
  EXPECT_EQ(give(CommandAction::Start).mode, DiskMode::Continuous);
  EXPECT_TRUE(source.orders.back().is_turning);
  EXPECT_DOUBLE_EQ(source.orders.back().speed_rad_s, kTurn_rad / 35.0);
}

TEST_F(CommandDeskTest, speed_is_kept_through_a_rest) {
  give(CommandAction::Stop);
  const auto ack = give(CommandAction::SetSpeed, -0.5);
  EXPECT_EQ(ack.mode, DiskMode::Idle);
  EXPECT_EQ(ack.speed_rad_s, -0.5);
  EXPECT_FALSE(source.orders.back().is_turning);
  EXPECT_EQ(give(CommandAction::Start).text, "continuous sweeps, a turn in 12.6 s clockwise");
  EXPECT_EQ(source.orders.back().speed_rad_s, -0.5);
}

TEST_F(CommandDeskTest, speed_that_is_none_for_the_drive_is_refused) {
  config::Settings coarse;
  coarse.motor.velocity_units_per_turn_per_s = 1.0;
  CommandDesk coarse_desk(coarse);
  coarse_desk.receive({kNow_us, 1, CommandAction::SetSpeed, 0.2});
  const auto ack = coarse_desk.obey(source, kNow_us).at(0);
  EXPECT_EQ(ack.result, CommandResult::BadValue);
  EXPECT_NE(ack.text.find("less than half of the drive's unit"), std::string::npos) << ack.text;
  EXPECT_TRUE(source.orders.empty());
}

TEST_F(CommandDeskTest, what_cannot_be_is_refused_with_the_reason_and_changes_nothing) {
  struct Case {
    const char* what;
    CommandAction action;
    double speed_rad_s;
    std::int64_t utime_us;
    CommandResult result;
    const char* text;
  };
  const Case cases[] = {
      {"standing", CommandAction::SetSpeed, 0.0, kNow_us, CommandResult::BadValue, "6.000 to 360.000 deg/s"},
      {"slower than a sweep may last", CommandAction::SetSpeed, 0.1, kNow_us, CommandResult::BadValue, "1 to 60 s"},
      {"too fast", CommandAction::SetSpeed, 7.0, kNow_us, CommandResult::BadValue, "clockwise"},
      {"no number", CommandAction::SetSpeed, kNaN, kNow_us, CommandResult::BadValue, "speed must be"},
      {"unknown", CommandAction::Unknown, 0.0, kNow_us, CommandResult::BadValue, "no such action"},
      {"recorded", CommandAction::Stop, 0.0, kNow_us - 11'000'000, CommandResult::TooOld, "given 11.0 s ago"},
      {"from tomorrow", CommandAction::Stop, 0.0, kNow_us + 86'400'000'000, CommandResult::TooOld, "in the future"},
      {"any time", CommandAction::Stop, 0.0, std::numeric_limits<std::int64_t>::min(), CommandResult::TooOld, "ago"},
  };
  for (const Case& entry : cases) {
    SCOPED_TRACE(entry.what);
    const auto ack = give(entry.action, entry.speed_rad_s, entry.utime_us);
    EXPECT_EQ(ack.result, entry.result);
    EXPECT_NE(ack.text.find(entry.text), std::string::npos) << ack.text;
    EXPECT_EQ(ack.mode, DiskMode::Continuous);
    EXPECT_DOUBLE_EQ(ack.speed_rad_s, kTurn_rad / 35.0);
  }
  EXPECT_TRUE(source.orders.empty());
}

TEST_F(CommandDeskTest, source_without_a_disk_refuses_in_its_own_words) {
  source.refusal = "this daemon plays a recording";
  const auto ack = give(CommandAction::Stop);
  EXPECT_EQ(ack.result, CommandResult::WrongSource);
  EXPECT_EQ(ack.text, source.refusal);
  EXPECT_EQ(desk.mode(), DiskMode::Continuous);
}

TEST_F(CommandDeskTest, repeated_command_is_answered_again_but_obeyed_once) {
  const ipc::CommandMessage command{kNow_us, 77, CommandAction::Stop, 0.0};
  desk.receive(command);
  desk.receive(command);
  const auto answers = desk.obey(source, kNow_us);
  ASSERT_EQ(answers.size(), 2u);
  give(CommandAction::Start);
  desk.receive(command);
  EXPECT_EQ(desk.obey(source, kNow_us + 5).at(0), answers[0]);
  EXPECT_EQ(answers[0], answers[1]);
  EXPECT_EQ(source.orders.size(), 2u);
  EXPECT_EQ(desk.mode(), DiskMode::Continuous);
}

TEST_F(CommandDeskTest, flood_of_commands_drops_the_oldest) {
  for (int i = 0; i < 16; ++i) EXPECT_TRUE(desk.receive({kNow_us, i, CommandAction::Start, 0.0}));
  EXPECT_FALSE(desk.receive({kNow_us, 16, CommandAction::Start, 0.0}));
  const auto answers = desk.obey(source, kNow_us);
  ASSERT_EQ(answers.size(), 16u);
  EXPECT_EQ(answers.front().id, 1);
}

TEST_F(CommandDeskTest, single_sweep_ends_with_the_first_whole_turn_that_began_after_the_command) {
  desk.note_sweep(sweep(0, kTurn_rad), source);
  give(CommandAction::SingleSweep);
  desk.note_sweep(sweep(1, kTurn_rad), source);
  EXPECT_EQ(desk.mode(), DiskMode::SingleSweep) << "it was under way when the command came";
  desk.note_sweep(sweep(2, 3.0), source);
  EXPECT_EQ(desk.mode(), DiskMode::SingleSweep);
  desk.note_sweep(sweep(3, kTurn_rad), source);
  EXPECT_EQ(desk.mode(), DiskMode::Idle);
  EXPECT_FALSE(source.orders.back().is_turning);
}

TEST_F(CommandDeskTest, after_a_rest_the_turn_under_way_counts_but_not_what_was_left_from_before) {
  give(CommandAction::Stop);
  give(CommandAction::SingleSweep);
  desk.note_sweep(sweep(0, kTurn_rad, scan::SweepEnd::NewStream), source);
  EXPECT_EQ(desk.mode(), DiskMode::SingleSweep);
  desk.note_sweep(sweep(1, 0.995 * kTurn_rad), source);
  EXPECT_EQ(desk.mode(), DiskMode::Idle);
}

TEST_F(CommandDeskTest, settings_may_ask_for_a_single_sweep_after_the_start) {
  config::Settings settings;
  settings.disk.mode = DiskMode::SingleSweep;
  CommandDesk single(settings);
  single.note_sweep(sweep(0, 3.0), source);
  EXPECT_EQ(single.mode(), DiskMode::SingleSweep);
  single.note_sweep(sweep(1, kTurn_rad), source);
  EXPECT_EQ(single.mode(), DiskMode::Idle);
  ASSERT_EQ(source.orders.size(), 1u);
  EXPECT_FALSE(source.orders.back().is_turning);
}

TEST_F(CommandDeskTest, sweeps_of_continuous_turning_end_nothing) {
  desk.note_sweep(sweep(0, kTurn_rad), source);
  EXPECT_EQ(desk.mode(), DiskMode::Continuous);
  EXPECT_TRUE(source.orders.empty());
}

}  // namespace
}  // namespace stairway::daemon
