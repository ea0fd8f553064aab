// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "detector/level_by_scene.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "detector/levelling.hpp"

namespace stairway::detect {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

/// A flat region as its principal axes tell it; the normal is the third direction.
PlaneRegion region(const Eigen::Vector3d& centroid, const Eigen::Vector3d& normal, double extent_m = 1.0,
                   std::size_t points = 2000) {
  PlaneRegion plane;
  plane.points.resize(points);
  const Eigen::Vector3d n = normal.normalized();
  const Eigen::Vector3d a = n.unitOrthogonal();
  plane.axes.centroid = centroid;
  plane.axes.axes << a, n.cross(a), n;
  plane.axes.variances = {extent_m * extent_m, extent_m * extent_m, 1e-4};
  return plane;
}

std::vector<PlaneRegion> room(const Eigen::Vector3d& floor_normal = Eigen::Vector3d::UnitZ()) {
  return {region({0, 0, 0}, floor_normal, 2.0, 20000),  region({0, 0, 2.6}, -Eigen::Vector3d::UnitZ()),
          region({3, 0, 1}, -Eigen::Vector3d::UnitX()), region({-3, 0, 1}, Eigen::Vector3d::UnitX()),
          region({0, 3, 1}, -Eigen::Vector3d::UnitY()), region({0, -3, 1}, Eigen::Vector3d::UnitY())};
}

std::vector<PlaneRegion> tilted(std::vector<PlaneRegion> planes, double roll_rad, double pitch_rad) {
  transform(planes, upright_from_roll_pitch(roll_rad, pitch_rad).inverse());
  return planes;
}

double angle_from_up(const SceneLevel& level, double roll_rad, double pitch_rad) {
  const Eigen::Vector3d up = upright_from_roll_pitch(roll_rad, pitch_rad).inverse().linear() * Eigen::Vector3d::UnitZ();
  return std::acos(std::min(1.0, (level.T_level_cloud.linear() * up).z()));
}

TEST(LevelByScene, finds_roll_and_pitch_of_the_robot) {
  for (const auto& [roll_deg, pitch_deg] : {std::pair{0.0, 0.0}, {3.0, 0.0}, {0.0, -3.0}, {-3.5, 3.5}}) {
    SCOPED_TRACE(::testing::Message() << roll_deg << ", " << pitch_deg);
    const auto level = level_by_scene(tilted(room(), roll_deg * kDegree, pitch_deg * kDegree));
    ASSERT_TRUE(level);
    EXPECT_LT(angle_from_up(*level, roll_deg * kDegree, pitch_deg * kDegree), 0.001 * kDegree);
    EXPECT_NEAR(level->roll_rad, roll_deg * kDegree, 0.02 * kDegree);
    EXPECT_NEAR(level->pitch_rad, pitch_deg * kDegree, 0.02 * kDegree);
    EXPECT_LT(level->sigma_rad, 0.1 * kDegree);
    EXPECT_EQ(level->planes, 8);  // two directions of each of the level ones
  }
}

TEST(LevelByScene, trusts_the_other_planes_where_the_floor_slopes) {
  const double slope = 0.02;
  const auto level = level_by_scene(room({-slope, 0.0, 1.0}));
  ASSERT_TRUE(level);
  EXPECT_LT(angle_from_up(*level, 0.0, 0.0), 0.1 * kDegree);
  ASSERT_TRUE(level->floor_slope_rad && level->floor);
  EXPECT_NEAR(*level->floor_slope_rad, std::atan(slope), 0.1 * kDegree);
  EXPECT_NEAR(level->floor_at({3.0, 1.0, 0.0}), 0.06, 0.006);
}

TEST(LevelByScene, sets_ramps_and_leaning_boards_aside) {
  std::vector<PlaneRegion> planes = room();
  planes.push_back(region({1, 1, 0.3}, {0.08, 0.0, 1.0}, 0.5));
  planes.push_back(region({2, 1, 0.5}, {1.0, 0.0, 0.09}, 0.5));
  const auto level = level_by_scene(planes);
  ASSERT_TRUE(level);
  EXPECT_LT(angle_from_up(*level, 0.0, 0.0), 0.02 * kDegree);
}

TEST(LevelByScene, is_not_guessed_from_too_little) {
  EXPECT_FALSE(level_by_scene({}));
  EXPECT_FALSE(level_by_scene({region({3, 0, 1}, -Eigen::Vector3d::UnitX())}));  // tells one direction only
  EXPECT_FALSE(level_by_scene({region({0, 0, 0.5}, Eigen::Vector3d::UnitZ(), 0.01, 110)}));
}

TEST(LevelByScene, knows_no_floor_that_is_not_underfoot) {
  std::vector<PlaneRegion> planes = room();
  planes.front().axes.centroid.z() = -1.5;
  const auto level = level_by_scene(planes);
  ASSERT_TRUE(level);
  EXPECT_FALSE(level->floor);
  EXPECT_EQ(level->floor_at({2.0, 0.0, 0.0}), 0.0);
}

}  // namespace
}  // namespace stairway::detect
