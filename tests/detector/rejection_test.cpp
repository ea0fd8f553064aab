// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <limits>

#include "detector/levelling.hpp"
#include "detector/stairway_detector.hpp"
#include "detector/voxel_grid.hpp"
#include "tests/detector/part_fixtures.hpp"
#include "tests/detector/scene_fixtures.hpp"

namespace stairway::detect {
namespace {

void expect_reason(const Detection& detection, const std::string& reason) {
  EXPECT_TRUE(detection.stairways.empty());
  ASSERT_FALSE(detection.rejected.empty());
  EXPECT_EQ(detection.rejected[0].reason, reason);
  EXPECT_FALSE(detection.rejected[0].detail.empty());
}

TEST(Rejection, names_a_flight_of_two_steps) {
  sim::StairSpec platform;
  platform.steps = 2;
  expect_reason(detect_stairways(test::simulate(platform, 1.5, 0.0, 8.0).cloud), "too-few-steps");
}

TEST(Rejection, an_empty_cloud_is_answered_with_a_reason) {
  const Detection detection = detect_stairways({});
  EXPECT_TRUE(detection.stairways.empty());
  ASSERT_EQ(detection.rejected.size(), 1U);
  EXPECT_EQ(detection.rejected[0].reason, "empty-cloud");
}

scan::PointCloud grid(double side_m, double spacing_m, double z_m = 0.0) {
  scan::PointCloud cloud;
  test::add_rectangle(cloud, {1.0, -0.5 * side_m, z_m}, {side_m, 0, 0}, {0, side_m, 0}, spacing_m);
  return cloud;
}

TEST(Rejection, a_cloud_without_a_finite_point_is_empty) {
  scan::PointCloud cloud;
  cloud.points.assign(100, Eigen::Vector3f::Constant(std::numeric_limits<float>::quiet_NaN()));
  expect_reason(detect_stairways(cloud), "empty-cloud");
}

TEST(Rejection, a_bare_floor_is_a_single_plane) { expect_reason(detect_stairways(grid(4.0, 0.02)), "single-plane"); }

TEST(Rejection, two_floors_have_no_pair_of_steps) {
  scan::PointCloud cloud = grid(4.0, 0.02);
  const scan::PointCloud ceiling = grid(4.0, 0.02, 2.5);
  cloud.points.insert(cloud.points.end(), ceiling.points.begin(), ceiling.points.end());
  expect_reason(detect_stairways(cloud), "no-step-pair");
}

class FaultyFlight : public testing::Test {
 protected:
  static const scan::PointCloud& flight() {
    static const scan::PointCloud cloud = [] {
      scan::PointCloud near = test::simulate({}, 1.5, 0.0, 4.0).cloud;
      std::erase_if(near.points, [](const Eigen::Vector3f& p) { return p.norm() > 6.0F || p.z() > 2.6F; });
      return near;
    }();
    return cloud;
  }
};

TEST_F(FaultyFlight, in_millimetres_has_suspicious_units) {
  scan::PointCloud millimetres = flight();
  for (Eigen::Vector3f& p : millimetres.points) p *= 1000.0F;
  const Detection detection = detect_stairways(millimetres);
  ASSERT_NO_FATAL_FAILURE(expect_reason(detection, "units-suspicious"));
  EXPECT_GT(detection.rejected[0].figures.at(0).second, 1000.0);
}

TEST_F(FaultyFlight, in_kilometres_has_suspicious_units) {
  scan::PointCloud kilometres = flight();
  for (Eigen::Vector3f& p : kilometres.points) p *= 0.001F;
  expect_reason(detect_stairways(kilometres), "units-suspicious");
}

TEST_F(FaultyFlight, that_leans_is_said_to_lean_and_by_how_much) {
  for (const double tilt_deg : {-35.0, -18.0, 18.0, 25.0}) {
    SCOPED_TRACE(tilt_deg);
    const Eigen::Isometry3d turn(Eigen::AngleAxisd(tilt_deg * M_PI / 180.0, Eigen::Vector3d::UnitY()));
    const Detection detection = detect_stairways(transformed(flight(), turn));
    ASSERT_NO_FATAL_FAILURE(expect_reason(detection, "cloud-tilted"));
    EXPECT_NEAR(detection.rejected[0].figures.at(0).second, std::abs(tilt_deg) * M_PI / 180.0, 0.05);
  }
}

TEST_F(FaultyFlight, of_few_points_is_too_sparse) {
  scan::PointCloud few = voxel_centroids(flight(), 0.15);
  const Detection detection = detect_stairways(few);
  ASSERT_NO_FATAL_FAILURE(expect_reason(detection, "too-sparse"));
  EXPECT_GT(detection.rejected[0].figures.at(0).second, detection.rejected[0].figures.at(1).second);
}

}  // namespace
}  // namespace stairway::detect
