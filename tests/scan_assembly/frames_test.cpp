// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "scan_assembly/frames.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>

namespace stairway::scan {
namespace {

using Eigen::Vector3d;

constexpr double kDegree = std::numbers::pi / 180.0;

// Direction of a beam in `base`.
Vector3d direction(const Calibration& calibration, double disk_rad, double beam_rad) {
  return calibration.T_base_lidar(disk_rad).linear() * Vector3d(std::cos(beam_rad), std::sin(beam_rad), 0.0);
}

double elevation_deg(const Vector3d& direction) { return std::asin(std::clamp(direction.z(), -1.0, 1.0)) / kDegree; }

TEST(Frames, front_beam_points_60_degrees_up_and_forward) {
  const Calibration calibration = make_calibration({});
  const Vector3d front = direction(calibration, 0.0, 0.0);
  EXPECT_NEAR(elevation_deg(front), 60.0, 1e-9);
  EXPECT_NEAR(front.y(), 0.0, 1e-12);
  EXPECT_GT(front.x(), 0.0);
}

TEST(Frames, beams_count_to_the_left_and_the_disk_turns_to_the_left) {
  const Calibration calibration = make_calibration({});
  EXPECT_NEAR((direction(calibration, 0.0, 90 * kDegree) - Vector3d::UnitY()).norm(), 0.0, 1e-12);
  const Vector3d front = direction(calibration, 90 * kDegree, 0.0);
  EXPECT_NEAR(front.x(), 0.0, 1e-12);
  EXPECT_GT(front.y(), 0.0);
}

TEST(Frames, default_mount_sees_98_degrees_of_elevation) {
  double lowest = 90.0, highest = -90.0;
  for (int k = 0; k <= 1080; ++k) {
    const double elevation = elevation_deg(direction(make_calibration({}), 0.7, (k - 540) * 0.25 * kDegree));
    lowest = std::min(lowest, elevation);
    highest = std::max(highest, elevation);
  }
  EXPECT_NEAR(lowest, -37.76, 0.01);
  EXPECT_NEAR(highest, 60.0, 1e-9);
}

TEST(Frames, inverted_mount_looks_down) {
  MountOptions options;
  options.scan_plane_pitch_rad = -60 * kDegree;
  const Calibration calibration = make_calibration(options);
  EXPECT_NEAR(elevation_deg(direction(calibration, 0.0, 0.0)), -60.0, 1e-9);
  EXPECT_NEAR(elevation_deg(direction(calibration, 0.0, 135 * kDegree)), 37.76, 0.01);
}

TEST(Frames, every_direction_is_seen_twice_in_a_turn) {
  const Calibration calibration = make_calibration({});
  for (const double beam_deg : {1.0, 30.0, 77.0, 120.0, 135.0}) {
    SCOPED_TRACE(beam_deg);
    const Vector3d left = direction(calibration, 0.3, beam_deg * kDegree);
    const Vector3d right = direction(calibration, 0.3, -beam_deg * kDegree);
    const double turn = std::atan2(left.y(), left.x()) - std::atan2(right.y(), right.x());
    EXPECT_GT(std::abs(std::remainder(turn, 2 * std::numbers::pi)), 0.01);
    EXPECT_NEAR((direction(calibration, 0.3 + turn, -beam_deg * kDegree) - left).norm(), 0.0, 1e-12);
  }
}

TEST(Frames, scanner_stands_half_a_metre_above_the_floor) {
  EXPECT_NEAR((make_calibration({}).T_base_lidar(1.0).translation() - Vector3d(0, 0, 0.5)).norm(), 0.0, 1e-12);
}

TEST(Frames, lever_arm_turns_with_the_disk_about_the_origin_that_is_reported) {
  MountOptions options;
  options.lever_arm_x_m = 0.1;
  options.lever_arm_z_m = 0.05;
  options.disk_x_m = 1.0;
  const Calibration calibration = make_calibration(options);
  EXPECT_NEAR((calibration.T_base_lidar(90 * kDegree).translation() - Vector3d(1.0, 0.1, 0.55)).norm(), 0.0, 1e-12);
  const Vector3d mean = 0.5 * (calibration.T_base_lidar(0.4).translation() +
                               calibration.T_base_lidar(0.4 + std::numbers::pi).translation());
  EXPECT_NEAR((calibration.mean_sensor_origin() - mean).norm(), 0.0, 1e-12);
}

TEST(Frames, yaw_turns_left_and_roll_lifts_the_left_side) {
  MountOptions options;
  options.scan_plane_pitch_rad = 0.0;
  options.scan_plane_yaw_rad = 10 * kDegree;
  EXPECT_GT(direction(make_calibration(options), 0.0, 0.0).y(), 0.1);
  options.scan_plane_yaw_rad = 0.0;
  options.scan_plane_roll_rad = 10 * kDegree;
  EXPECT_GT(direction(make_calibration(options), 0.0, 90 * kDegree).z(), 0.1);
}

TEST(MountOptions, name_what_is_wrong) {
  EXPECT_EQ(MountOptions{}.problem(), "");
  MountOptions options;
  options.scan_plane_pitch_rad = 90 * kDegree;
  EXPECT_NE(options.problem().find("scan_plane_pitch"), std::string::npos);
  options = {};
  options.disk_z_m = std::numeric_limits<double>::quiet_NaN();
  EXPECT_NE(options.problem().find("disk_z"), std::string::npos);
  options = {};
  options.lever_arm_y_m = -1.5;
  EXPECT_NE(options.problem().find("lever_arm_y"), std::string::npos);
}

}  // namespace
}  // namespace stairway::scan
