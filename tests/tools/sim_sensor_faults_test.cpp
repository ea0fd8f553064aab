// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cstdint>
#include <string>

#include "tests/tools/sensor_bench.hpp"
#include "tools/sim/sensor_faults.hpp"

namespace stairway::sim {
namespace {

using drivers::ScipOptions;
using drivers::ScipState;
using drivers::ScipTrouble;

struct FaultCase {
  const char* name;
  SensorFault fault;
  int count;
  double longest_s;  // until 40 more scans, themselves a second
  ScipTrouble trouble;
};

class FaultInTheStream : public testing::TestWithParam<FaultCase> {};

TEST_P(FaultInTheStream, is_told_and_the_stream_comes_back) {
  const FaultCase& param = GetParam();
  SensorBench bench;
  ASSERT_GE(bench.time_to_scans(80, 5.0), 0.0);
  bench.sensor.inject(param.fault, param.count);
  const double taken_s = bench.time_to_scans(40, 60.0);
  EXPECT_GE(taken_s, 0.0);
  EXPECT_LE(taken_s, param.longest_s);
  EXPECT_GE(bench.count(param.trouble), 1U);
  EXPECT_EQ(bench.wrong_scans, 0U);
  EXPECT_EQ(bench.session.state(), ScipState::Streaming);

  const std::uint64_t troubles_before = bench.count(param.trouble);
  EXPECT_LE(bench.time_to_scans(80, 60.0), 2.1);
  EXPECT_EQ(bench.count(param.trouble), troubles_before);
  for (std::size_t i = 1; i < bench.scans.size(); ++i) {
    ASSERT_GT(bench.scans[i].sequence, bench.scans[i - 1].sequence);
    ASSERT_GT(bench.scans[i].first_beam_stamp_ns, bench.scans[i - 1].first_beam_stamp_ns);
  }
}

INSTANTIATE_TEST_SUITE_P(
    Sensor, FaultInTheStream,
    testing::Values(FaultCase{"garbage", SensorFault::Garbage, 5, 1.2, ScipTrouble::Corrupt},
                    FaultCase{"bad_sum", SensorFault::BadSum, 5, 1.2, ScipTrouble::Corrupt},
                    FaultCase{"lost_line_feed", SensorFault::LostLineFeed, 5, 1.4, ScipTrouble::Corrupt},
                    FaultCase{"stuck", SensorFault::Stuck, 1, 1.6, ScipTrouble::Silence},
                    FaultCase{"self_check", SensorFault::SelfCheck, 80, 3.2, ScipTrouble::SelfCheck},
                    FaultCase{"laser_fault", SensorFault::LaserFault, 1, 1.6, ScipTrouble::SensorFault},
                    FaultCase{"clock_reset", SensorFault::ClockReset, 1, 1.1, ScipTrouble::ClockReset},
                    FaultCase{"repeated_stamp", SensorFault::RepeatedStamp, 5, 1.2, ScipTrouble::RepeatedStamp},
                    FaultCase{"wrong_length", SensorFault::WrongLength, 1, 1.6, ScipTrouble::Corrupt}),
    [](const auto& one) { return one.param.name; });

TEST(SensorFaults, a_laser_that_fails_three_times_is_opened_anew_and_works) {
  SensorBench bench;
  ASSERT_GE(bench.time_to_scans(80, 5.0), 0.0);
  bench.sensor.inject(SensorFault::LaserFault, 4);
  EXPECT_GE(bench.time_to_scans(40, 30.0), 0.0);
  EXPECT_EQ(bench.count(ScipTrouble::SensorFault), 4U);
}

TEST(SensorFaults, a_clock_that_jumps_ahead_costs_no_scan) {
  SensorBench bench;
  ASSERT_GE(bench.time_to_scans(80, 5.0), 0.0);
  bench.sensor.inject(SensorFault::ClockJump);
  EXPECT_LE(bench.time_to_scans(40, 5.0), 1.1);
  EXPECT_EQ(bench.session.clock_quality().resets, 1U);
  for (std::size_t i = 1; i < bench.scans.size(); ++i) {
    EXPECT_EQ(bench.scans[i].sequence, bench.scans[i - 1].sequence + 1);
  }
}

TEST(SensorFaults, old_firmware_is_told_and_used) {
  FakeUtm30lxOptions options;
  options.firmware = "1.16.02(19/Jan./2010)";
  SensorBench bench(options);
  EXPECT_GE(bench.time_to_scans(40, 5.0), 0.0);
  EXPECT_EQ(bench.count(ScipTrouble::OldFirmware), 1U);
}

struct OpeningCase {
  const char* name;
  SensorFault fault;
  int count;
  double longest_s;
};

class FaultWhileOpening : public testing::TestWithParam<OpeningCase> {};

TEST_P(FaultWhileOpening, is_overcome_after_some_failures) {
  const OpeningCase& param = GetParam();
  SensorBench bench;
  bench.sensor.receive("MD0000108001000\n", bench.now_ns - 1'000'000'000);  // left streaming by an earlier run
  bench.sensor.inject(param.fault, param.count);
  const double taken_s = bench.time_to_scans(40, 120.0);
  EXPECT_GE(taken_s, 0.0);
  EXPECT_LE(taken_s, param.longest_s);
  EXPECT_EQ(bench.wrong_scans, 0U);
}

INSTANTIATE_TEST_SUITE_P(Sensor, FaultWhileOpening,
                         testing::Values(OpeningCase{"garbage", SensorFault::Garbage, 40, 12.0},
                                         OpeningCase{"stat_trouble", SensorFault::StatTrouble, 3, 10.0},
                                         OpeningCase{"quit_ignored", SensorFault::QuitIgnored, 2, 5.0},
                                         OpeningCase{"quit_ignored_long", SensorFault::QuitIgnored, 7, 16.0},
                                         OpeningCase{"laser_not_ready", SensorFault::LaserNotReady, 8, 12.0},
                                         OpeningCase{"laser_not_ready_long", SensorFault::LaserNotReady, 25, 40.0}),
                         [](const auto& one) { return one.param.name; });

TEST(SensorFaults, an_overloaded_sensor_loses_scans_and_gives_no_wrong_one) {
  ScipOptions options;
  options.intensities = true;
  options.force_intensities = true;
  SensorBench bench({}, options);
  EXPECT_GE(bench.time_to_scans(40, 10.0), 0.0);
  EXPECT_GE(bench.count(ScipTrouble::Corrupt), 5U);
  EXPECT_EQ(bench.wrong_scans, 0U);
}

TEST(SensorFaults, a_sensor_that_fails_in_every_way_at_once_comes_back) {
  SensorBench bench;
  ASSERT_GE(bench.time_to_scans(80, 5.0), 0.0);
  for (std::size_t i = 0; i < kSensorFaults; ++i) bench.sensor.inject(static_cast<SensorFault>(i), 3);
  EXPECT_GE(bench.time_to_scans(100, 120.0), 0.0);
  EXPECT_EQ(bench.wrong_scans, 0U);
}

}  // namespace
}  // namespace stairway::sim
