// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "tools/stairwayd/preview_schedule.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

namespace stairway::daemon {
namespace {

constexpr double kTurn_rad = 2.0 * std::numbers::pi;

/// A sweep after so many seconds of a turn that takes 35.
scan::Sweep sweep_after(double seconds, double speed_rad_s = kTurn_rad / 35.0) {
  scan::Sweep sweep;
  sweep.begin_ns = 7'000'000'000;
  sweep.end_ns = sweep.begin_ns + std::llround(1e9 * seconds);
  sweep.cloud.points.resize(static_cast<std::size_t>(40'000 * seconds));
  sweep.statistics.covered_angle_rad = speed_rad_s * seconds;
  return sweep;
}

std::vector<double> previews(PreviewSchedule& schedule, std::uint64_t number = 0, double step_s = 0.5) {
  std::vector<double> when_s;
  for (double at_s = 0.0; at_s < 35.0; at_s += step_s) {
    scan::Sweep sweep = sweep_after(at_s);
    sweep.number = number;
    if (schedule.take_due(sweep, 0)) when_s.push_back(at_s);
  }
  return when_s;
}

TEST(PreviewSchedule, looks_often_until_everything_was_seen_once_and_not_shortly_before_the_end) {
  PreviewSchedule schedule({.every_s = 2.5});
  const std::vector<double> wanted{2.5, 5.0, 7.5, 10.0, 12.5, 15.0, 17.5, 20.0, 30.0};
  EXPECT_EQ(previews(schedule), wanted);
  EXPECT_EQ(previews(schedule, 1), wanted) << "every sweep anew";
}

TEST(PreviewSchedule, late_question_is_answered_late_and_moves_none_of_the_others) {
  PreviewSchedule schedule({.every_s = 2.5});
  EXPECT_FALSE(schedule.take_due(sweep_after(2.4), 0));
  EXPECT_TRUE(schedule.take_due(sweep_after(4.0), 0));
  EXPECT_FALSE(schedule.take_due(sweep_after(4.9), 0));
  EXPECT_TRUE(schedule.take_due(sweep_after(5.0), 0));
  EXPECT_TRUE(schedule.take_due(sweep_after(10.2), 0));
  EXPECT_FALSE(schedule.take_due(sweep_after(12.4), 0));
}

TEST(PreviewSchedule, too_few_points_or_a_disk_that_stands_are_no_news) {
  PreviewSchedule schedule({.every_s = 1.0});
  scan::Sweep sweep = sweep_after(2.0);
  sweep.cloud.points.resize(19'999);
  EXPECT_FALSE(schedule.take_due(sweep, 0));
  EXPECT_FALSE(schedule.take_due(sweep_after(10.0, 0.0), 0));
  EXPECT_TRUE(schedule.take_due(sweep_after(10.0), 0));
  EXPECT_FALSE(schedule.take_due(sweep_after(20.0, 0.5 * kTurn_rad / 35.0), 0));
}

TEST(PreviewSchedule, run_that_is_played_is_looked_at_where_it_was) {
  PreviewSchedule schedule({.every_s = 1.0}, std::vector<std::int64_t>{5'000'000, 9'000'000});
  EXPECT_FALSE(schedule.take_due(sweep_after(4.0), 4'000'000));
  EXPECT_TRUE(schedule.take_due(sweep_after(5.0), 5'000'001)) << "the clocks are not read to the microsecond";
  EXPECT_FALSE(schedule.take_due(sweep_after(5.0), 5'000'001)) << "once";
  EXPECT_FALSE(schedule.take_due(sweep_after(8.975), 8'975'000));
  EXPECT_TRUE(schedule.take_due(sweep_after(9.0), 9'000'000));
}

TEST(PreviewSchedule, zero_switches_them_off) {
  PreviewSchedule schedule({.every_s = 0.0});
  EXPECT_TRUE(previews(schedule).empty());
}

}  // namespace
}  // namespace stairway::daemon
