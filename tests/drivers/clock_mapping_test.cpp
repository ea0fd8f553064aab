// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "drivers/scip/clock_mapping.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <vector>

namespace stairway::drivers {
namespace {

constexpr double kNominalPeriod_ns = 25e6;

// A sensor with its own clock, seen through a line with delays.
struct SensorModel {
  double period_ns = 25e6;       // of the mirror, host time
  double device_rate = 1.00005;  // device seconds per host second
  double device_origin_ms = 1234.567;
  double latency_ns = 0.5e6;
  double jitter_ns = 0.4e6;  // mean of an exponential distribution
  std::mt19937 random{42};

  HostStamp true_stamp_ns(std::int64_t turn) const {
    return 1'000'000'000 + std::llround(static_cast<double>(turn) * period_ns);
  }
  std::int64_t device_stamp_ms(std::int64_t turn) const {
    return static_cast<std::int64_t>(
        std::floor(device_origin_ms + static_cast<double>(true_stamp_ns(turn)) * 1e-6 * device_rate));
  }
  HostStamp arrival_ns(std::int64_t turn) {
    const double uniform = (static_cast<double>(random()) + 0.5) / 4294967296.0;
    return true_stamp_ns(turn) + std::llround(latency_ns - jitter_ns * std::log(uniform));
  }
};

ClockMapping make_mapping(const SensorModel& sensor) {
  ClockOptions options;
  options.minimum_latency_ns = sensor.latency_ns;
  return ClockMapping(options, kNominalPeriod_ns);
}

double error_ms(const ScanTime& time, HostStamp truth_ns) {
  return static_cast<double>(time.stamp_ns - truth_ns) * 1e-6;
}

TEST(ClockMapping, is_right_to_a_fifth_of_a_millisecond_after_two_seconds) {
  struct Case {
    std::string name;
    double period_ns, device_rate;
  };
  for (const auto& [name, period_ns, device_rate] : std::vector<Case>{{"50 ppm", 25e6, 1.00005},
                                                                      {"-50 ppm", 25e6, 0.99995},
                                                                      {"same clock", 25e6, 1.0},
                                                                      {"24.87 ms", 24.87e6, 1.00005},
                                                                      {"25.4 ms", 25.4e6, 1.0001}}) {
    for (unsigned seed = 1; seed <= 20; ++seed) {
      SCOPED_TRACE(name + " seed " + std::to_string(seed));
      SensorModel sensor;
      sensor.period_ns = period_ns;
      sensor.device_rate = device_rate;
      sensor.random.seed(seed);
      ClockMapping mapping = make_mapping(sensor);
      for (std::int64_t turn = 0; turn < 1200; ++turn) {
        const ScanTime time = mapping.add(sensor.device_stamp_ms(turn), sensor.arrival_ns(turn), true);
        ASSERT_EQ(time.sequence, static_cast<std::uint64_t>(turn));
        if (turn < 80) continue;
        ASSERT_LT(std::abs(error_ms(time, sensor.true_stamp_ns(turn))), 0.2) << "turn " << turn;
        ASSERT_NEAR(time.period_ns, period_ns, 5e3);
      }
    }
  }
}

TEST(ClockMapping, is_right_to_a_tenth_of_a_millisecond_when_settled) {
  SensorModel sensor;
  ClockMapping mapping = make_mapping(sensor);
  double sum = 0.0, worst = 0.0;
  for (std::int64_t turn = 0; turn < 4000; ++turn) {
    const ScanTime time = mapping.add(sensor.device_stamp_ms(turn), sensor.arrival_ns(turn), true);
    if (turn < 400) continue;
    sum += std::abs(error_ms(time, sensor.true_stamp_ns(turn)));
    worst = std::max(worst, std::abs(error_ms(time, sensor.true_stamp_ns(turn))));
  }
  EXPECT_LT(worst, 0.1);
  EXPECT_LT(sum / 3600, 0.03);
  EXPECT_NEAR(mapping.quality().drift_ppm, -50.0, 15.0);
  EXPECT_NEAR(mapping.quality().period_ms, 25.0, 0.001);
  EXPECT_NEAR(mapping.quality().mean_delay_ms, 0.4, 0.1);
  EXPECT_EQ(mapping.quality().resets, 0U);
}

TEST(ClockMapping, is_never_later_than_an_arrival_allows) {
  SensorModel sensor;
  ClockMapping mapping = make_mapping(sensor);
  for (std::int64_t turn = 0; turn < 500; ++turn) {
    const HostStamp arrival_ns = sensor.arrival_ns(turn);
    const ScanTime time = mapping.add(sensor.device_stamp_ms(turn), arrival_ns, true);
    ASSERT_LE(error_ms(time, arrival_ns) + sensor.latency_ns * 1e-6, 1e-5);
  }
}

TEST(ClockMapping, counts_lost_scans_by_the_device_stamp) {
  SensorModel sensor;
  ClockMapping mapping = make_mapping(sensor);
  std::int64_t turn = 0;
  for (const std::int64_t step : {0, 1, 1, 2, 1, 5, 1, 30, 1, 1}) {
    turn += step;
    const ScanTime time = mapping.add(sensor.device_stamp_ms(turn), sensor.arrival_ns(turn), true);
    EXPECT_EQ(time.sequence, static_cast<std::uint64_t>(turn));
  }
}

TEST(ClockMapping, shrugs_off_a_host_that_was_busy) {
  SensorModel sensor;
  ClockMapping mapping = make_mapping(sensor);
  for (std::int64_t turn = 0; turn < 400; ++turn) {
    const bool is_busy = turn >= 200 && turn < 220;
    const HostStamp arrival_ns = is_busy ? sensor.true_stamp_ns(220) : sensor.arrival_ns(turn);
    const ScanTime time = mapping.add(sensor.device_stamp_ms(turn), arrival_ns, true);
    if (turn > 80) {
      ASSERT_LT(std::abs(error_ms(time, sensor.true_stamp_ns(turn))), 0.2) << turn;
    }
  }
  EXPECT_EQ(mapping.quality().resets, 0U);
}

TEST(ClockMapping, ignores_arrivals_that_belong_to_another_scan) {
  SensorModel sensor;
  ClockMapping mapping = make_mapping(sensor);
  for (std::int64_t turn = 0; turn < 400; ++turn) {
    const bool is_exact = turn % 3 == 0;
    const HostStamp arrival_ns = sensor.arrival_ns(turn) - (is_exact ? 0 : 2'000'000);
    const ScanTime time = mapping.add(sensor.device_stamp_ms(turn), arrival_ns, is_exact);
    if (turn > 120) {
      ASSERT_LT(std::abs(error_ms(time, sensor.true_stamp_ns(turn))), 0.2) << turn;
    }
  }
}

TEST(ClockMapping, begins_anew_when_the_device_clock_is_set_back) {
  SensorModel sensor;
  ClockMapping mapping = make_mapping(sensor);
  for (std::int64_t turn = 0; turn < 200; ++turn) {
    mapping.add(sensor.device_stamp_ms(turn), sensor.arrival_ns(turn), true);
  }
  sensor.device_origin_ms -= 5000.0;
  ScanTime time;
  for (std::int64_t turn = 300; turn < 400; ++turn) {
    time = mapping.add(sensor.device_stamp_ms(turn), sensor.arrival_ns(turn), true);
  }
  EXPECT_LT(std::abs(error_ms(time, sensor.true_stamp_ns(399))), 0.2);
  EXPECT_EQ(time.sequence, 399U);
  EXPECT_EQ(mapping.quality().resets, 1U);
}

TEST(ClockMapping, follows_a_host_clock_that_jumps_within_three_seconds) {
  for (const std::int64_t jump_ns : {-7'000'000'000LL, 7'000'000'000LL, -20'000'000LL, 20'000'000LL}) {
    SCOPED_TRACE(jump_ns);
    SensorModel sensor;
    ClockMapping mapping = make_mapping(sensor);
    ScanTime time;
    for (std::int64_t turn = 0; turn < 440; ++turn) {
      const HostStamp shift_ns = turn < 300 ? 0 : jump_ns;
      time = mapping.add(sensor.device_stamp_ms(turn), sensor.arrival_ns(turn) + shift_ns, true);
    }
    EXPECT_LT(std::abs(error_ms(time, sensor.true_stamp_ns(439) + jump_ns)), 0.2);
  }
}

TEST(ClockMapping, gives_plausible_times_from_the_first_scan_on) {
  SensorModel sensor;
  sensor.period_ns = 24.87e6;
  ClockMapping mapping = make_mapping(sensor);
  for (std::int64_t turn = 0; turn < 80; ++turn) {
    const ScanTime time = mapping.add(sensor.device_stamp_ms(turn), sensor.arrival_ns(turn), true);
    ASSERT_LT(std::abs(error_ms(time, sensor.true_stamp_ns(turn))), 3.0) << turn;
    ASSERT_NEAR(time.period_ns, 25e6, 0.5e6 + 1.0);
  }
}

TEST(ClockMapping, survives_repeated_and_absurd_stamps) {
  ClockMapping mapping({}, kNominalPeriod_ns);
  std::uint64_t last = 0;
  for (const std::int64_t stamp_ms : {100LL, 100LL, 100LL, 4'000'000'000'000'000LL, -5LL, 0LL, 25LL}) {
    const ScanTime time = mapping.add(stamp_ms, static_cast<HostStamp>(last) * 25'000'000, true);
    EXPECT_GE(time.sequence, last);
    last = time.sequence + 1;
    EXPECT_NEAR(time.period_ns, 25e6, 0.5e6 + 1.0);
  }
}

TEST(ClockOptions, name_what_is_wrong) {
  EXPECT_EQ(ClockOptions{}.problem(), "");
  ClockOptions options;
  options.window_s = std::nan("");
  EXPECT_NE(options.problem().find("window"), std::string::npos);
  options = {};
  options.minimum_latency_ns = -1.0;
  EXPECT_NE(options.problem().find("minimum_latency"), std::string::npos);
}

}  // namespace
}  // namespace stairway::drivers
