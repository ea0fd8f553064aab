// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "detector/levelling.hpp"

#include <gtest/gtest.h>

#include "tests/detector/part_fixtures.hpp"

namespace stairway::detect {
namespace {

scan::PointCloud room() {
  scan::PointCloud cloud;
  test::add_rectangle(cloud, {-2, -2, 0}, {4, 0, 0}, {0, 4, 0}, 0.05);
  test::add_rectangle(cloud, {-2, -2, 2.5}, {4, 0, 0}, {0, 4, 0}, 0.05);
  test::add_rectangle(cloud, {2, -2, 0}, {0, 4, 0}, {0, 0, 2.5}, 0.05);
  test::add_rectangle(cloud, {0.5, -0.5, 0.7}, {1, 0, 0}, {0, 1, 0}, 0.05);  // a table
  cloud.sensor_origin = Eigen::Vector3f(0, 0, 0.5F);
  return cloud;
}

TEST(Levelling, finds_the_floor_below_ceiling_and_table_at_any_tilt) {
  for (const double roll : {-0.15, 0.0, 0.12}) {
    for (const double pitch : {-0.1, 0.0, 0.2}) {
      SCOPED_TRACE(roll);
      SCOPED_TRACE(pitch);
      Eigen::Isometry3d tilt = upright_from_roll_pitch(roll, pitch).inverse();
      tilt.pretranslate(Eigen::Vector3d(0.3, -0.2, -1.1));
      const std::optional<FloorFit> floor = find_floor(transformed(room(), tilt));
      ASSERT_TRUE(floor);
      const Eigen::Isometry3d back = floor->T_level_cloud * tilt;
      EXPECT_GT(back.linear()(2, 2), 1.0 - 1e-6) << "level again";
      EXPECT_NEAR((back * Eigen::Vector3d(0, 0, 0)).z(), 0.0, 1e-3) << "floor at zero";
      EXPECT_NEAR(floor->tilt_rad, std::acos(tilt.linear()(2, 2)), 1e-3);
    }
  }
}

TEST(Levelling, says_when_there_is_no_floor) {
  EXPECT_FALSE(find_floor({}));
  scan::PointCloud wall;
  test::add_rectangle(wall, {2, -2, 0}, {0, 4, 0}, {0, 0, 2.5}, 0.05);
  EXPECT_FALSE(find_floor(wall));
  EXPECT_FALSE(find_floor(transformed(room(), upright_from_roll_pitch(0.6, 0.0)))) << "tilted beyond the limit";
}

TEST(Levelling, turns_gravity_down_with_the_least_turn) {
  for (const Eigen::Vector3d& gravity : {Eigen::Vector3d(0, 0, -9.81), Eigen::Vector3d(1, 0, 0),
                                         Eigen::Vector3d(0, 0, 5), Eigen::Vector3d(-0.3, 4.0, -9.0)}) {
    const Eigen::Isometry3d upright = upright_from_gravity(gravity);
    EXPECT_LT((upright.linear() * gravity.normalized() + Eigen::Vector3d::UnitZ()).norm(), 1e-9);
  }
  EXPECT_TRUE(upright_from_gravity({0, 0, -1}).isApprox(Eigen::Isometry3d::Identity(), 1e-12));
}

TEST(Levelling, moves_the_sensor_with_the_cloud) {
  const scan::PointCloud moved = transformed(room(), Eigen::Isometry3d(Eigen::Translation3d(1, 2, 3)));
  EXPECT_LT((*moved.sensor_origin - Eigen::Vector3f(1, 2, 3.5F)).norm(), 1e-6F);
}

}  // namespace
}  // namespace stairway::detect
