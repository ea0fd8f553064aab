// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <string>

#include "config/load_settings.hpp"
#include "config/settings_table.hpp"
#include "tests/tools/recording_fixture.hpp"
#include "tests/tools/temporary_folder.hpp"
#include "tools/recording/measurement_order.hpp"
#include "tools/recording/recorded_settings.hpp"
#include "tools/recording/recorded_sweeps.hpp"
#include "tools/stairway/playback_schedule.hpp"

namespace stairway::tools {
namespace {

using namespace std::chrono_literals;
using test::fixture_angles;
using test::fixture_scan;
using test::FixtureOptions;
using test::TemporaryFolder;
using test::write_fixture;

// Scans as "s" and the scan's number, angles as "a" and that of the scan they came behind.
std::string taken(MeasurementOrder& order) {
  std::string text;
  while (const auto measurement = order.next()) {
    if (const auto* scan = std::get_if<drivers::LaserScan>(&*measurement)) {
      text += "s" + std::to_string(scan->sequence) + " ";
    } else {
      const auto& samples = std::get<std::vector<drivers::AngleSample>>(*measurement);
      text += "a" + std::to_string(samples.back().stamp_ns / test::kFixtureScanPeriod_ns - 1) + " ";
    }
  }
  return text;
}

TEST(MeasurementOrder, angles_come_behind_the_scan_they_came_behind) {
  MeasurementOrder order;
  for (int i = 0; i < 3; ++i) {
    order.add(fixture_angles(i));
    order.add(fixture_scan(i));
  }
  EXPECT_EQ(taken(order), "s0 a0 s1 a1 s2 a2 ");
}

TEST(MeasurementOrder, scans_that_were_sent_late_come_in_their_place) {
  MeasurementOrder order;
  for (int i = 0; i < 3; ++i) order.add(fixture_angles(i));
  EXPECT_EQ(taken(order), "");
  for (int i = 0; i < 3; ++i) order.add(fixture_scan(i));
  EXPECT_EQ(taken(order), "s0 a0 s1 a1 s2 a2 ");
}

TEST(MeasurementOrder, angles_before_the_first_scan_come_at_once) {
  MeasurementOrder order;
  ipc::AnglesMessage angles = fixture_angles(0);
  angles.scan_stamp_ns = ipc::AnglesMessage{}.scan_stamp_ns;
  order.add(angles);
  EXPECT_EQ(taken(order), "a0 ");
}

TEST(MeasurementOrder, lost_scan_holds_nothing_up) {
  MeasurementOrder order;
  for (int i = 0; i < 5; ++i) {
    order.add(fixture_angles(i));
    if (i != 1 && i != 4) order.add(fixture_scan(i));
  }
  EXPECT_EQ(taken(order), "s0 a0 a1 s2 a2 s3 a3 ");
  order.end();
  EXPECT_EQ(taken(order), "a4 ");
}

TEST(MeasurementOrder, waits_for_no_scan_for_ever) {
  MeasurementOrder order;
  for (int i = 0; i < 2000; ++i) order.add(fixture_angles(i));
  const std::string text = taken(order);
  EXPECT_EQ(std::ranges::count(text, 'a'), 1500);
}

TEST(RecordedSettings, those_that_decide_are_taken_and_unknown_ones_are_named) {
  config::Settings settings;
  settings.detector.voxel_m = 0.0175;
  settings.lcm.channel_prefix = "OTHER_";
  const RecordedSettings recorded = recorded_settings(config::to_toml(settings) + "[detector]\nlong_gone = 3\n");
  EXPECT_EQ(recorded.unknown_keys, std::vector<std::string>{"detector.long_gone"});
  const auto loaded = config::load_settings({{}, recorded.assignments});
  ASSERT_TRUE(loaded) << loaded.error().text;
  EXPECT_EQ(loaded->settings.detector.voxel_m, 0.0175);
  EXPECT_EQ(loaded->settings.lcm.channel_prefix, "STAIRWAY_");
}

RecordingFacts examined(const std::string& path) {
  auto facts = examine_recording(path);
  if (!facts) ADD_FAILURE() << facts.error().text;
  return facts.value_or(RecordingFacts{});
}

TEST(RecordedSweeps, one_turn_gives_one_sweep_and_the_rest_is_left_out) {
  const TemporaryFolder folder;
  write_fixture(folder.path("a.lcm"));
  const RecordingFacts facts = examined(folder.path("a.lcm"));
  EXPECT_EQ(facts.channel_prefix, "STAIRWAY_");
  EXPECT_TRUE(facts.has_angles);
  EXPECT_EQ(facts.settings->version, "1.2.3");
  auto sweeps = RecordedSweeps::open(folder.path("a.lcm"), facts, {});
  ASSERT_TRUE(sweeps);
  const auto sweep = sweeps->next();
  ASSERT_TRUE(sweep);
  EXPECT_EQ(sweep->cloud.points.size(), 4000u);
  EXPECT_EQ(sweeps->measurements().utime_us(sweep->begin_ns), test::kFixtureUtime_us);
  EXPECT_FALSE(sweeps->next());
  EXPECT_EQ(describe_flaws(sweeps->measurements()), "");
}

TEST(RecordedSweeps, part_of_a_turn_is_better_than_nothing) {
  const TemporaryFolder folder;
  write_fixture(folder.path("a.lcm"), {.scans = 10});
  auto sweeps = RecordedSweeps::open(folder.path("a.lcm"), examined(folder.path("a.lcm")), {});
  const auto sweep = sweeps->next();
  ASSERT_TRUE(sweep);
  EXPECT_EQ(sweep->cloud.points.size(), 1000u);
  EXPECT_FALSE(sweep->statistics.flaws().empty());
  EXPECT_FALSE(sweeps->next());
}

TEST(RecordedSweeps, without_angles_those_at_the_ends_of_the_scans_serve) {
  const TemporaryFolder folder;
  write_fixture(folder.path("a.lcm"), {.scans = 45, .has_angles = false});
  const RecordingFacts facts = examined(folder.path("a.lcm"));
  EXPECT_FALSE(facts.has_angles);
  auto sweeps = RecordedSweeps::open(folder.path("a.lcm"), facts, {});
  const auto sweep = sweeps->next();
  ASSERT_TRUE(sweep);
  EXPECT_EQ(sweep->cloud.points.size(), 4000u);
}

TEST(RecordedSweeps, file_without_scans_is_refused_with_the_reason) {
  const TemporaryFolder folder;
  test::write_text(folder.path("a.lcm"), "no log");
  write_fixture(folder.path("b.lcm"), {.scans = 0});
  EXPECT_NE(examine_recording(folder.path("a.lcm")).error().text.find("no LCM event"), std::string::npos);
  EXPECT_NE(examine_recording(folder.path("b.lcm")).error().text.find("ends in SCAN"), std::string::npos);
}

class Schedule : public testing::Test {
 protected:
  static constexpr std::int64_t kSecond_us = 1'000'000;
  const PlaybackSchedule::Time start{};
};

TEST_F(Schedule, messages_are_due_at_the_rate) {
  PlaybackSchedule schedule(2.0);
  schedule.next(100 * kSecond_us, start);
  EXPECT_TRUE(schedule.is_due(start));
  schedule.next(104 * kSecond_us, start);
  EXPECT_FALSE(schedule.is_due(start + 1999ms));
  EXPECT_TRUE(schedule.is_due(start + 2s));
  // One that was late does not make the others late.
  schedule.next(106 * kSecond_us, start + 5s);
  EXPECT_TRUE(schedule.is_due(start + 5s));
  schedule.next(110 * kSecond_us, start + 5s);
  EXPECT_EQ(schedule.left(start + 4s), 1s);
}

TEST_F(Schedule, rate_zero_is_as_fast_as_possible) {
  PlaybackSchedule schedule(0.0);
  for (std::int64_t i = 0; i < 5; ++i) {
    schedule.next(i * kSecond_us, start);
    EXPECT_TRUE(schedule.is_due(start));
  }
}

TEST_F(Schedule, jumps_of_the_recorded_clock_do_not_stop_it) {
  PlaybackSchedule schedule(1.0);
  schedule.next(0, start);
  schedule.next(1'700'000'000 * kSecond_us, start);
  EXPECT_TRUE(schedule.is_due(start + 10s));
  schedule.next(5 * kSecond_us, start + 10s);
  EXPECT_TRUE(schedule.is_due(start + 10s));
}

TEST_F(Schedule, pause_keeps_what_is_left_and_a_step_lets_one_pass) {
  PlaybackSchedule schedule(1.0);
  schedule.next(0, start);
  schedule.next(4 * kSecond_us, start);
  schedule.pause(start + 1s);
  EXPECT_FALSE(schedule.is_due(start + 1h));
  schedule.step();
  EXPECT_TRUE(schedule.is_due(start + 1h));
  schedule.next(6 * kSecond_us, start + 1h);
  EXPECT_FALSE(schedule.is_due(start + 2h));
  schedule.resume(start + 2h);
  EXPECT_EQ(schedule.left(start + 2h), 2s);
  EXPECT_TRUE(schedule.is_due(start + 2h + 2s));
}

}  // namespace
}  // namespace stairway::tools
