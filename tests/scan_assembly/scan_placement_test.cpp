// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "scan_assembly/scan_placement.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "tests/scan_assembly/turning_scanner.hpp"

namespace stairway::scan {
namespace {

using drivers::BeamStatus;

constexpr drivers::HostStamp kMs = 1'000'000;

AngleTrack track_of(const TurningScanner& scanner, drivers::HostStamp until_ns, drivers::HostStamp step_ns = 2 * kMs) {
  AngleTrack track;
  for (drivers::HostStamp at_ns = -step_ns; at_ns <= until_ns; at_ns += step_ns) track.add(scanner.sample(at_ns));
  return track;
}

Calibration tilted_calibration() {
  MountOptions options;
  options.scan_plane_roll_rad = 0.05;
  options.scan_plane_yaw_rad = -0.3;
  options.lever_arm_x_m = 0.07;
  options.lever_arm_y_m = -0.02;
  options.disk_x_m = 0.3;
  Calibration calibration = make_calibration(options);
  calibration.T_base_disk.rotate(Eigen::AngleAxisd(0.02, Eigen::Vector3d::UnitX()));
  return calibration;
}

TEST(ScanPlacement, puts_every_point_on_the_wall_it_came_from_while_the_disk_turns_fast) {
  for (const double speed_rad_s : {6.28, -6.28, 0.18, 0.0}) {
    SCOPED_TRACE(speed_rad_s);
    TurningScanner scanner;
    scanner.calibration = tilted_calibration();
    scanner.speed_rad_s = speed_rad_s;
    const AngleTrack track = track_of(scanner, 30 * kMs);
    ScanPlacer placer(scanner.calibration);
    PlacedScan placed;
    placer.place(scanner.scan(0), track, placed);
    ASSERT_EQ(placed.points.size(), 1081U);
    for (const Eigen::Vector3f& point : placed.points) {
      ASSERT_LT(scanner.distance_to_room_m(point.cast<double>()), 2e-6);
    }
  }
}

TEST(ScanPlacement, agrees_with_one_transform_per_beam) {
  TurningScanner scanner;
  scanner.calibration = tilted_calibration();
  scanner.speed_rad_s = 3.0;
  const AngleTrack track = track_of(scanner, 60 * kMs, 7 * kMs);
  ScanPlacer placer(scanner.calibration);
  PlacedScan placed;
  const drivers::LaserScan scan = scanner.scan(1);
  placer.place(scan, track, placed);
  ASSERT_EQ(placed.points.size(), 1081U);
  for (std::size_t i = 0; i < placed.points.size(); i += 7) {
    const auto stamp_ns = scan.first_beam_stamp_ns + std::llround(static_cast<double>(i) * scan.beam_interval_ns);
    const double beam_rad = scan.first_angle_rad + static_cast<double>(i) * scan.angle_increment_rad;
    const Eigen::Vector3d p_lidar =
        static_cast<double>(scan.ranges_m[i]) * Eigen::Vector3d(std::cos(beam_rad), std::sin(beam_rad), 0.0);
    const Eigen::Vector3d p_base = scanner.calibration.T_base_lidar(scanner.angle_rad(stamp_ns)) * p_lidar;
    ASSERT_LT((placed.points[i].cast<double>() - p_base).norm(), 1e-6);
    ASSERT_NEAR(placed.disk_angles_rad[i], scanner.angle_rad(stamp_ns), 1e-7);
    ASSERT_EQ(placed.beams[i], i);
  }
  EXPECT_NEAR(placed.last_angle_rad.value(), scanner.angle_rad(25 * kMs + 18'750'000), 1e-7);
}

TEST(ScanPlacement, counts_every_beam_once_and_says_why_it_was_dropped) {
  TurningScanner scanner;
  drivers::LaserScan scan = scanner.scan(0);
  scan.statuses[0] = BeamStatus::NoReturn;
  scan.statuses[1] = BeamStatus::TooNear;
  scan.statuses[2] = scan.statuses[3] = BeamStatus::Disturbed;
  scan.statuses[4] = BeamStatus::Invalid;
  scan.ranges_m[5] = std::numeric_limits<float>::quiet_NaN();
  scan.ranges_m[6] = 0.09F;
  scan.ranges_m[7] = 30.1F;
  scan.ranges_m[8] = std::numeric_limits<float>::infinity();
  ScanPlacer placer(scanner.calibration);
  PlacedScan placed;
  placer.place(scan, track_of(scanner, 30 * kMs), placed);
  const BeamCounts expected{
      .kept = 1072, .no_return = 1, .too_near = 1, .disturbed = 2, .invalid = 3, .out_of_limits = 2};
  EXPECT_EQ(placed.counts, expected);
  EXPECT_EQ(placed.points.size(), 1072U);
  EXPECT_EQ(placed.beams.front(), 9);
}

TEST(ScanPlacement, keeps_only_beams_whose_angle_is_known_and_valid) {
  TurningScanner scanner;
  AngleTrack track;
  for (int ms = 0; ms <= 10; ++ms) track.add({ms * kMs, scanner.angle_rad(ms * kMs), ms != 5});
  drivers::LaserScan scan = scanner.scan(0);
  scan.first_beam_stamp_ns = -2 * kMs;
  ScanPlacer placer(scanner.calibration);
  PlacedScan placed;
  AngleTrackOptions options;
  placer.place(scan, track, placed);
  // 2 ms before the first sample, none valid from 4 to 6 ms; known until 10 ms past the newest = the scan's end.
  const double beams_per_ms = 1440.0 / 25.0;
  EXPECT_NEAR(static_cast<double>(placed.counts.no_angle), 2 * beams_per_ms, 1.0);
  EXPECT_NEAR(static_cast<double>(placed.counts.angle_invalid), 2 * beams_per_ms, 1.0);
  EXPECT_EQ(placed.counts.total(), 1081U);
  EXPECT_EQ(placed.points.size(), placed.counts.kept);
}

TEST(ScanPlacement, survives_impossible_scans) {
  TurningScanner scanner;
  const AngleTrack track = track_of(scanner, 30 * kMs);
  ScanPlacer placer(scanner.calibration);
  PlacedScan placed;
  placer.place({}, track, placed);
  EXPECT_EQ(placed.counts.total(), 0U);

  drivers::LaserScan scan = scanner.scan(0);
  scan.statuses.resize(10);
  placer.place(scan, track, placed);
  EXPECT_EQ(placed.counts.total(), 10U);

  for (const double interval_ns : {0.0, -17361.0, 1e300, std::nan("")}) {
    SCOPED_TRACE(interval_ns);
    scan = scanner.scan(0);
    scan.first_beam_stamp_ns = 20 * kMs;
    scan.beam_interval_ns = interval_ns;
    placer.place(scan, track, placed);
    EXPECT_EQ(placed.counts.total(), 1081U);
    for (const Eigen::Vector3f& point : placed.points) ASSERT_TRUE(point.allFinite());
  }
}

TEST(RangeLimits, name_what_is_wrong) {
  EXPECT_EQ(RangeLimits{}.problem(), "");
  EXPECT_NE((RangeLimits{2.0, 1.0}.problem()), "");
  EXPECT_NE((RangeLimits{-1.0, 1.0}.problem()), "");
  EXPECT_NE((RangeLimits{0.1, 1000.0}.problem()), "");
}

}  // namespace
}  // namespace stairway::scan
