// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "detector/normals.hpp"

#include <gtest/gtest.h>

#include <random>

#include "tests/detector/part_fixtures.hpp"

namespace stairway::detect {
namespace {

double share_within(const SurfaceNormals& surface, const Eigen::Vector3f& expected, double angle_rad) {
  std::size_t good = 0;
  for (const Eigen::Vector3f& n : surface.normals)
    if (std::abs(n.dot(expected)) > std::cos(angle_rad)) ++good;
  return static_cast<double>(good) / static_cast<double>(surface.normals.size());
}

TEST(Normals, of_a_noisy_riser_near_the_robot_hold_where_a_narrow_neighbourhood_fails) {
  std::mt19937 engine(2);
  std::normal_distribution<float> noise(0.0F, 0.010F);
  scan::PointCloud cloud;
  test::add_rectangle(cloud, {2, -0.6, 0}, {0, 1.2, 0}, {0, 0, 0.17}, 0.008);
  for (Eigen::Vector3f& p : cloud.points) p.x() += noise(engine);
  cloud.sensor_origin = Eigen::Vector3f(0, 0, 0.5F);
  const SurfaceNormals metric = estimate_normals(cloud);
  EXPECT_GT(share_within(metric, Eigen::Vector3f::UnitX(), 0.26), 0.95);
  const SurfaceNormals narrow = estimate_normals(cloud, {.radius_m = 0.024, .min_neighbours = 3});
  EXPECT_LT(share_within(narrow, Eigen::Vector3f::UnitX(), 0.26), 0.80);
}

TEST(Normals, face_the_sensor) {
  scan::PointCloud cloud;
  test::add_rectangle(cloud, {2, -1, 0}, {0, 2, 0}, {0, 0, 1}, 0.02);
  cloud.sensor_origin = Eigen::Vector3f(5, 0, 0.5F);
  for (const Eigen::Vector3f& n : estimate_normals(cloud).normals) EXPECT_GT(n.x(), 0.99F);
  cloud.sensor_origin = Eigen::Vector3f(-5, 0, 0.5F);
  for (const Eigen::Vector3f& n : estimate_normals(cloud).normals) EXPECT_LT(n.x(), -0.99F);
}

TEST(Normals, take_farther_neighbours_where_the_cloud_is_sparse) {
  scan::PointCloud cloud;
  test::add_rectangle(cloud, {0, 0, 1}, {2, 0, 0}, {0, 2, 0}, 0.2);
  for (const Eigen::Vector3f& n : estimate_normals(cloud).normals) EXPECT_GT(std::abs(n.z()), 0.99F);
}

TEST(Normals, of_no_or_a_few_points_are_harmless) {
  EXPECT_TRUE(estimate_normals({}).normals.empty());
  scan::PointCloud two;
  two.points = {{0, 0, 0}, {1, 0, 0}};
  EXPECT_EQ(estimate_normals(two).normals.size(), 2U);
}

}  // namespace
}  // namespace stairway::detect
