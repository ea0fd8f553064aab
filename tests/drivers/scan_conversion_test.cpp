// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "drivers/scip/scan_conversion.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace stairway::drivers {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

TEST(ScanConversion, knows_every_error_distance) {
  const SensorParameters sensor;
  EXPECT_EQ(classify_range(0, sensor), BeamStatus::Invalid);
  EXPECT_EQ(classify_range(1, sensor), BeamStatus::NoReturn);
  EXPECT_EQ(classify_range(2, sensor), BeamStatus::TooNear);
  EXPECT_EQ(classify_range(3, sensor), BeamStatus::Disturbed);
  EXPECT_EQ(classify_range(4, sensor), BeamStatus::TooNear);
  for (std::uint32_t code = 5; code < 23; ++code) EXPECT_EQ(classify_range(code, sensor), BeamStatus::Invalid);
  EXPECT_EQ(classify_range(23, sensor), BeamStatus::Ok);
  EXPECT_EQ(classify_range(60000, sensor), BeamStatus::Ok);
  EXPECT_EQ(classify_range(60001, sensor), BeamStatus::NoReturn);
  EXPECT_EQ(classify_range(65533, sensor), BeamStatus::NoReturn);
}

TEST(ScanConversion, gives_metres_only_to_beams_that_have_them) {
  const RawScan raw{0, {1000, 1, 3, 30000}, {}};
  const LaserScan scan = to_laser_scan(raw, {}, {}, 0, {0, 0, 25e6}, StampReference::Rear);
  ASSERT_EQ(scan.ranges_m.size(), 4U);
  EXPECT_FLOAT_EQ(scan.ranges_m[0], 1.0F);
  EXPECT_TRUE(std::isnan(scan.ranges_m[1]));
  EXPECT_TRUE(std::isnan(scan.ranges_m[2]));
  EXPECT_FLOAT_EQ(scan.ranges_m[3], 30.0F);
}

TEST(ScanConversion, dates_and_directs_beams_of_a_window) {
  ScanRequest request;
  request.first_step = 540;
  request.last_step = 900;
  const ScanTime time{7, 1'000'000'000, 25e6};
  const LaserScan rear = to_laser_scan({}, request, {}, 123, time, StampReference::Rear);
  EXPECT_EQ(rear.sequence, 7U);
  EXPECT_EQ(rear.device_stamp_ms, 123);
  EXPECT_EQ(rear.first_beam_stamp_ns, 1'012'500'000);
  EXPECT_NEAR(rear.first_angle_rad, 0.0, 1e-12);
  const LaserScan step0 = to_laser_scan({}, request, {}, 123, time, StampReference::Step0);
  EXPECT_EQ(rear.first_beam_stamp_ns - step0.first_beam_stamp_ns, 3'125'000);
}

TEST(ScanConversion, puts_a_group_of_steps_in_its_middle) {
  ScanRequest request;
  request.cluster = 3;
  request.skip_scan = 1;
  const LaserScan scan = to_laser_scan({}, request, {}, 0, {0, 0, 50e6}, StampReference::Step0);
  EXPECT_NEAR(scan.first_angle_rad, -134.75 * kDegree, 1e-9);
  EXPECT_NEAR(scan.angle_increment_rad, 0.75 * kDegree, 1e-9);
  EXPECT_NEAR(scan.beam_interval_ns, 3 * 25e6 / 1440, 1e-3);
  EXPECT_EQ(scan.first_beam_stamp_ns, 17361);
}

}  // namespace
}  // namespace stairway::drivers
