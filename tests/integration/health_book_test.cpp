// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "tools/stairwayd/health_book.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "tools/stairwayd/reason_code.hpp"
#include "tools/stairwayd/status_text.hpp"

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
  book.note({Device::Encoder, Condition::Failed, "no such chip", 0, "disconnected"});
  book.note(SourceSign{Device::Scanner, 80}, kStart + 1s);
  book.count_trouble({Device::Encoder, "encoder: disconnected", "no such chip"});
  book.count_trouble({Device::Encoder, "encoder: disconnected", "no such chip"});
  book.count_trouble({std::nullopt, "measurements dropped", ""});
  book.note({Device::Motor, Condition::Starting, "searching", 0, "searching"});
  book.note(drivers::ClockQuality{.period_ms = 25.1, .mean_delay_ms = 0.5, .resets = 2});
  const ipc::HealthMessage health = book.report(kStart + 3s, 0);
  const std::vector<ipc::DeviceHealth> expected{{"scanner", "streaming", "", true, 80.0 / 3.0, 2.0, 0},
                                                {"disk motor", "searching", "searching", false, 0.0, -1.0, 0},
                                                {"encoder", "no such chip", "disconnected", false, 0.0, -1.0, 2}};
  EXPECT_EQ(health.devices, expected);
  EXPECT_EQ(health.clock.period_ms, 25.1);
  EXPECT_EQ(health.clock.resets, 2);
  EXPECT_LT(health.clock.bound_ms, 0.0) << "nobody measured the latency";
  EXPECT_EQ(health.reasons, std::vector<std::string>{"encoder:disconnected"});
  const std::vector<std::pair<std::string, std::int64_t>> drops{{"encoder:disconnected", 2},
                                                                {"measurements-dropped", 1}};
  EXPECT_EQ(health.drops, drops);
}

TEST(HealthBook, the_bound_of_the_clock_is_half_the_round_trip) {
  HealthBook book(kStart);
  book.note(drivers::ClockQuality{.source = drivers::ClockSource::TimeAdjustment, .round_trip_ms = 1.5});
  EXPECT_DOUBLE_EQ(book.report(kStart, 0).clock.bound_ms, 0.75);
}

TEST(HealthBook, what_keeps_messages_from_others_is_told_beside_the_measurements) {
  HealthBook book(kStart);
  book.note({Device::Scanner, Condition::Failed, "unplugged"});
  book.note(ipc::RecorderStatus{.trouble = "disk full"});
  book.note_bus("no route");
  const ipc::HealthMessage health = book.report(kStart, 0);
  EXPECT_EQ(health.state, "scanner: unplugged; not recording: disk full; not sending: no route");
  EXPECT_EQ(health.reasons, (std::vector<std::string>{"scanner:failed", "not-recording", "not-sending"}));
  book.note_bus("");
  EXPECT_EQ(book.report(kStart, 0).reasons.size(), 2U);
}

TEST(HealthBook, results_have_an_age_from_their_first_on) {
  HealthBook book(kStart);
  const ipc::ResultHealth none = book.report(kStart, 0).result;
  EXPECT_EQ(none, ipc::ResultHealth{});
  scan::Sweep sweep;
  sweep.number = 4;
  sweep.cloud.points.resize(3);
  book.note_sweep(sweep, kStart + 1s);
  ipc::StairwaysMessage answer;
  answer.sweep = 4;
  answer.detection.stairways.resize(2);
  book.note_answer(answer, {{"total", 8.0}}, kStart + 2s);
  answer.sweep = 5;
  answer.detection.stairways.clear();
  book.note_answer(answer, {{"total", 4.0}}, kStart + 3s);
  const ipc::HealthMessage health = book.report(kStart + 5s, 0);
  EXPECT_EQ(health.result.sweep, 4);
  EXPECT_EQ(health.result.sweep_points, 3);
  EXPECT_DOUBLE_EQ(health.result.sweep_age_s, 4.0);
  EXPECT_EQ(health.result.stairways, 0);
  EXPECT_EQ(health.result.stairway_sweep, 4);
  EXPECT_DOUBLE_EQ(health.result.stairway_age_s, 3.0);
  EXPECT_EQ(health.stages, (std::vector<ipc::StageHealth>{{"total", 4.0, 8.0}}));
}

TEST(HealthBook, preview_may_show_a_stairway_but_does_not_deny_one) {
  HealthBook book(kStart);
  ipc::StairwaysMessage preview{.sweep = 3, .is_final = false};
  book.note_preview(preview, {{"fit", 1.0}, {"total", 8.0}}, kStart);
  EXPECT_EQ(book.report(kStart, 0).result, ipc::ResultHealth{});
  preview.detection.stairways.resize(1);
  book.note_preview(preview, {{"fit", 1.0}, {"total", 9.0}}, kStart + 1s);
  const ipc::HealthMessage health = book.report(kStart + 3s, 0);
  EXPECT_EQ(health.result.stairways, -1);
  EXPECT_EQ(health.result.stairway_sweep, 3);
  EXPECT_DOUBLE_EQ(health.result.stairway_age_s, 2.0);
  EXPECT_EQ(health.stages, (std::vector<ipc::StageHealth>{{"preview", 8.0, 9.0}}));
}

TEST(StageStatistics, percentiles_are_those_of_the_last_hundred_runs) {
  StageStatistics stages;
  for (int i = 0; i < 50; ++i) stages.add("fit", 1e6);
  for (int i = 100; i > 0; --i) stages.add("fit", i);
  stages.add("railing", 7.0);
  EXPECT_EQ(stages.report(), (std::vector<ipc::StageHealth>{{"fit", 50.0, 95.0}, {"railing", 7.0, 7.0}}));
}

TEST(ReasonCode, is_what_a_program_can_compare) {
  EXPECT_EQ(reason_code("scanner: corrupt message"), "scanner:corrupt-message");
  EXPECT_EQ(reason_code("disk motor: CAN bus"), "disk-motor:can-bus");
  EXPECT_EQ(reason_code("unseen-sweeps"), "unseen-sweeps");
  EXPECT_EQ(reason_code(""), "");
}

TEST(StatusText, is_one_line_with_what_matters) {
  ipc::HealthMessage health;
  health.state = "scanning\nREADY=1";
  health.sweep = 3;
  health.sweep_progress = 0.25;
  health.devices = {{"scanner", "streaming", "", true, 40.0, 0.02, 1},
                    {"encoder", "lost", "dead-line", false, 0, 7.2, 0}};
  health.drops = {{"no-return", 12}, {"unseen-sweeps", 2}};
  EXPECT_EQ(
      status_text(health),
      "scanning READY=1 | sweep 3 25 %, scanner 40/s 1 troubles, encoder 0/s silent 7 s, unseen-sweeps 2, no answer "
      "yet");
  health.result.stairways = 0;
  health.result.stairway_age_s = 40.0;
  EXPECT_NE(status_text(health).find("0 stairways in the last answer, one 40 s ago"), std::string::npos);
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
  book.note_sweep(sweep, kStart);
  book.note_sweep(sweep, kStart);
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
