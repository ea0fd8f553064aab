// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "detector/extents.hpp"

#include <gtest/gtest.h>

#include <numeric>

#include "tests/detector/part_fixtures.hpp"

namespace stairway::detect {
namespace {

std::vector<std::uint32_t> all_of(const scan::PointCloud& cloud) {
  std::vector<std::uint32_t> all(cloud.points.size());
  std::iota(all.begin(), all.end(), 0U);
  return all;
}

TEST(Extents, of_a_rectangle_are_its_edges) {
  scan::PointCloud cloud;
  test::add_rectangle(cloud, {0, -0.6, 0.1}, {0, 1.2, 0}, {0, 0, 0.17}, 0.01);
  const Interval z =
      robust_extent(cloud.points, all_of(cloud), Eigen::Vector3d::UnitZ(), Eigen::Vector3d::UnitY(), 0.05);
  EXPECT_NEAR(z.low, 0.10, 1e-6);
  EXPECT_NEAR(z.high, 0.27, 1e-6);
}

TEST(Extents, ignore_a_few_stray_points) {
  scan::PointCloud cloud;
  test::add_rectangle(cloud, {0, -0.6, 0.1}, {0, 1.2, 0}, {0, 0, 0.17}, 0.01);
  cloud.points.emplace_back(0.0F, 0.0F, 0.9F);
  cloud.points.emplace_back(0.0F, 0.2F, -0.5F);
  const Interval z =
      robust_extent(cloud.points, all_of(cloud), Eigen::Vector3d::UnitZ(), Eigen::Vector3d::UnitY(), 0.05);
  EXPECT_NEAR(z.low, 0.10, 1e-6);
  EXPECT_NEAR(z.high, 0.27, 1e-6);
  EXPECT_NEAR(full_extent(cloud.points, all_of(cloud), Eigen::Vector3d::UnitZ()).high, 0.9, 1e-6);
}

TEST(Extents, ignore_a_corner_that_something_hides) {
  scan::PointCloud cloud;
  test::add_rectangle(cloud, {0, -0.6, 0.1}, {0, 1.2, 0}, {0, 0, 0.17}, 0.01);
  std::erase_if(cloud.points, [](const Eigen::Vector3f& p) { return p.y() > 0.2F && p.z() > 0.15F; });
  const Interval z =
      robust_extent(cloud.points, all_of(cloud), Eigen::Vector3d::UnitZ(), Eigen::Vector3d::UnitY(), 0.05);
  EXPECT_NEAR(z.high, 0.27, 1e-6);
}

TEST(Extents, of_scattered_points_reach_from_the_first_to_the_last) {
  const std::vector<Eigen::Vector3f> points{{0, 0, 0}, {0, 1, 0.3F}};
  const std::vector<std::uint32_t> both{0, 1};
  const Interval z = robust_extent(points, both, Eigen::Vector3d::UnitZ(), Eigen::Vector3d::UnitY(), 0.05);
  EXPECT_NEAR(z.length(), 0.3, 1e-6);
}

TEST(Extents, overlap_is_negative_across_a_gap) {
  EXPECT_DOUBLE_EQ(overlap({0, 2}, {1, 5}), 1.0);
  EXPECT_DOUBLE_EQ(overlap({0, 2}, {3, 5}), -1.0);
}

}  // namespace
}  // namespace stairway::detect
