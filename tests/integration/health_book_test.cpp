// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "tools/stairwayd/health_book.hpp"

#include <gtest/gtest.h>

#include <numbers>

namespace stairway::daemon {
namespace {

using namespace std::chrono_literals;

const HealthBook::Clock::time_point kStart{};

drivers::LaserScan scan_with(int points) {
  drivers::LaserScan scan;
  scan.statuses.assign(10, drivers::BeamStatus::NoReturn);
  std::fill_n(scan.statuses.begin(), points, drivers::BeamStatus::Ok);
  return scan;
}

scan::AngleTrack turning_track(double end_rad, double direction) {
  scan::AngleTrack track;
  for (int i = 10; i >= 0; --i) track.add({(10 - i) * 10'000'000, end_rad - direction * 0.01 * i, true});
  return track;
}

TEST(HealthBook, rates_are_those_since_the_last_report) {
  HealthBook book(kStart);
  book.note({Device::Scanner, Condition::Good, "streaming"});
  for (int i = 0; i < 40; ++i) book.note_scan(scan_with(3));
  book.note_angles(117, turning_track(1.0, 1.0));
  const ipc::HealthMessage first = book.report(kStart + 2s, 5);
  EXPECT_EQ(first.utime_us, 5);
  EXPECT_EQ(first.state, "scanning");
  EXPECT_DOUBLE_EQ(first.scan_rate_hz, 20.0);
  EXPECT_DOUBLE_EQ(first.disk_rate_hz, 58.5);
  EXPECT_EQ(first.points, 120);
  EXPECT_DOUBLE_EQ(book.report(kStart + 3s, 6).scan_rate_hz, 0.0);
}

TEST(HealthBook, state_names_the_part_that_is_silent) {
  HealthBook book(kStart);
  EXPECT_EQ(book.report(kStart, 0).state, "starting");
  book.note({Device::Scanner, Condition::Starting, "opening"});
  book.note({Device::Motor, Condition::Starting, "searching"});
  EXPECT_EQ(book.report(kStart, 0).state, "scanner: opening; disk motor: searching");
  book.note({Device::Motor, Condition::Failed, "can0 is down"});
  EXPECT_EQ(book.report(kStart, 0).state, "disk motor: can0 is down") << "what has failed hides what only starts";
  book.note({Device::Motor, Condition::Good, "running"});
  book.note({Device::Scanner, Condition::Good, "streaming"});
  EXPECT_EQ(book.report(kStart, 0).state, "no scans arrive");
  book.note_scan(scan_with(1));
  EXPECT_EQ(book.report(kStart, 0).state, "no disk angles arrive");
  book.note_scan(scan_with(1));
  scan::AngleTrack lost;
  lost.add({0, 0.0, false});
  book.note_angles(1, lost);
  EXPECT_EQ(book.report(kStart, 0).state, "waiting for the disk's index");
  book.note_stop();
  EXPECT_EQ(book.report(kStart, 0).state, "stopped");
}

TEST(HealthBook, every_device_is_told_with_the_age_of_its_data_and_its_troubles) {
  HealthBook book(kStart);
  book.note({Device::Scanner, Condition::Good, "streaming"});
  book.note({Device::Encoder, Condition::Failed, "no such chip"});
  book.note_sign(Device::Scanner, kStart + 1s);
  book.count_trouble({Device::Encoder, "encoder: disconnected", "no such chip"});
  book.count_trouble({Device::Encoder, "encoder: disconnected", "no such chip"});
  book.count_trouble({std::nullopt, "measurements dropped", ""});
  book.note(drivers::ClockQuality{.period_ms = 25.1, .mean_delay_ms = 0.5, .resets = 2});
  const ipc::HealthMessage health = book.report(kStart + 3s, 0);
  const std::vector<ipc::DeviceHealth> expected{{"scanner", "streaming", true, 2.0, 0},
                                                {"encoder", "no such chip", false, -1.0, 2}};
  EXPECT_EQ(health.devices, expected);
  EXPECT_EQ(health.clock.period_ms, 25.1);
  EXPECT_EQ(health.clock.resets, 2);
  const std::vector<std::pair<std::string, std::int64_t>> drops{{"encoder: disconnected", 2},
                                                                {"measurements dropped", 1}};
  EXPECT_EQ(health.drops, drops);
}

TEST(HealthBook, progress_is_the_share_of_the_turn_in_either_direction) {
  constexpr double kTurn_rad = 2.0 * std::numbers::pi;
  HealthBook book(kStart);
  book.note_angles(1, turning_track(2.25 * kTurn_rad, 1.0));
  EXPECT_NEAR(book.report(kStart, 0).sweep_progress, 0.25, 1e-9);
  book.note_angles(1, turning_track(-0.75 * kTurn_rad, -1.0));
  EXPECT_NEAR(book.report(kStart, 0).sweep_progress, 0.75, 1e-9);
}

TEST(HealthBook, sweep_ends_add_their_drops) {
  HealthBook book(kStart);
  book.note_scan(scan_with(4));
  scan::Sweep sweep;
  sweep.number = 2;
  sweep.statistics.beams.no_return = 7;
  sweep.statistics.lost_scans = 1;
  book.note_sweep(sweep);
  book.note_sweep(sweep);
  book.count("unsent-messages");
  const ipc::HealthMessage health = book.report(kStart, 0);
  EXPECT_EQ(health.sweep, 3);
  EXPECT_EQ(health.points, 0);
  const std::vector<std::pair<std::string, std::int64_t>> expected{
      {"lost-scans", 2}, {"no-return", 14}, {"unsent-messages", 1}};
  EXPECT_EQ(health.drops, expected);
}

}  // namespace
}  // namespace stairway::daemon
