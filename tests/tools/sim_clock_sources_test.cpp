// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "tests/tools/sensor_bench.hpp"

namespace stairway::sim {
namespace {

using drivers::ClockSource;
using drivers::LaserScan;
using drivers::ScipOptions;
using drivers::ScipTrouble;
using drivers::TimeSource;

constexpr double kTurn_ns = 25e6;
constexpr double kRearToFirst_ns = 3.125e6;

// By how much the newest scan's time differs from the truth: turns begin at whole multiples of 25 ms [ms].
double error_ms(const SensorBench& bench) {
  return 1e-6 * std::remainder(static_cast<double>(bench.scans.back().first_beam_stamp_ns) - kRearToFirst_ns, kTurn_ns);
}

// A line of which the settings know too little: 5 ms slower than they say.
FakeUtm30lxOptions slow_line() {
  FakeUtm30lxOptions options;
  options.latency_s = 0.0285;
  return options;
}

ScipOptions by_time_adjustment() {
  ScipOptions options;
  options.clock_source = TimeSource::TimeAdjustment;
  return options;
}

TEST(ClockSources, a_wrong_latency_in_the_settings_shifts_the_scans) {
  SensorBench bench(slow_line());
  ASSERT_GE(bench.time_to_scans(100, 5.0), 0.0);
  EXPECT_NEAR(error_ms(bench), 5.0, 0.3);
  EXPECT_EQ(bench.session.clock_quality().source, ClockSource::Passive);
  EXPECT_EQ(bench.session.clock_quality().latency_ms, 23.5);
}

TEST(ClockSources, a_sensor_that_tells_its_time_quickly_measures_the_latency) {
  FakeUtm30lxOptions sensor = slow_line();
  sensor.answers_time_at_once = true;
  SensorBench bench(sensor, by_time_adjustment());
  ASSERT_GE(bench.time_to_scans(100, 5.0), 0.0);
  // The counter of whole milliseconds allows for one of them.
  EXPECT_NEAR(error_ms(bench), 0.0, 1.1);
  const auto quality = bench.session.clock_quality();
  EXPECT_EQ(quality.source, ClockSource::TimeAdjustment);
  EXPECT_NEAR(quality.latency_ms, 28.5, 1.1);
  EXPECT_NEAR(quality.round_trip_ms, 1.0, 0.01);
  EXPECT_EQ(bench.count(ScipTrouble::TimeUnknown), 0U);
}

TEST(ClockSources, answers_on_the_grid_of_turns_are_not_believed) {
  SensorBench bench(slow_line(), by_time_adjustment());
  ASSERT_GE(bench.time_to_scans(100, 8.0), 0.0);
  EXPECT_EQ(bench.count(ScipTrouble::TimeUnknown), 1U);
  EXPECT_EQ(bench.session.clock_quality().source, ClockSource::Passive);
  EXPECT_NEAR(error_ms(bench), 5.0, 0.3);
}

TEST(ClockSources, time_adjustment_that_is_denied_while_booting_is_asked_for_again) {
  FakeUtm30lxOptions sensor = slow_line();
  sensor.answers_time_at_once = true;
  SensorBench bench(sensor, by_time_adjustment());
  bench.sensor.inject(SensorFault::TimeRefused, 4);
  ASSERT_GE(bench.time_to_scans(100, 12.0), 0.0);
  EXPECT_EQ(bench.count(ScipTrouble::Refused), 0U) << "a sensor that boots is no trouble";
  EXPECT_EQ(bench.session.clock_quality().source, ClockSource::TimeAdjustment);
}

TEST(ClockSources, time_adjustment_that_is_always_denied_is_done_without) {
  SensorBench bench({}, by_time_adjustment());
  bench.sensor.inject(SensorFault::TimeRefused, 1000);
  ASSERT_GE(bench.time_to_scans(100, 20.0), 0.0);
  EXPECT_EQ(bench.count(ScipTrouble::TimeUnknown), 1U);
}

TEST(ClockSources, sync_pulses_show_the_true_turn) {
  ScipOptions options;
  options.sync_offset_ns = 9e6;
  options.clock.minimum_latency_ns = 25e6;  // 3.5 ms from the truth
  FakeUtm30lxOptions sensor = slow_line();
  SensorBench bench(sensor, options);
  bench.pulse_phase_ns = 9'000'000;
  ASSERT_GE(bench.time_to_scans(120, 8.0), 0.0);
  EXPECT_EQ(bench.session.clock_quality().source, ClockSource::SyncPulse);
  EXPECT_NEAR(error_ms(bench), 0.0, 0.1);

  bench.pulse_phase_ns.reset();
  ASSERT_GE(bench.time_to_scans(120, 8.0), 0.0);
  EXPECT_EQ(bench.session.clock_quality().source, ClockSource::Passive);
  EXPECT_NEAR(error_ms(bench), 3.5, 0.3);
  for (std::size_t i = 1; i < bench.scans.size(); ++i) {
    ASSERT_EQ(bench.scans[i].sequence, bench.scans[i - 1].sequence + 1);
    ASSERT_GT(bench.scans[i].first_beam_stamp_ns, bench.scans[i - 1].first_beam_stamp_ns);
  }
}

TEST(ClockSources, misplaced_sync_pulses_are_told_and_left_out) {
  SensorBench bench;
  bench.pulse_phase_ns = 9'000'000;
  ASSERT_GE(bench.time_to_scans(120, 8.0), 0.0);
  EXPECT_EQ(bench.session.clock_quality().source, ClockSource::Passive);
  EXPECT_EQ(bench.count(ScipTrouble::SyncPulse), 1U);
  EXPECT_NEAR(bench.session.clock_quality().sync_residual_ms, 9.0, 1.0);
  EXPECT_NEAR(error_ms(bench), 0.0, 0.3);
}

TEST(ClockSources, stamps_behind_their_own_arrival_are_told_once) {
  ScipOptions options;
  options.clock.minimum_latency_ns = 0.0;
  SensorBench bench({}, options);
  ASSERT_GE(bench.time_to_scans(120, 8.0), 0.0);
  EXPECT_EQ(bench.count(ScipTrouble::FutureStamp), 1U);
}

}  // namespace
}  // namespace stairway::sim
