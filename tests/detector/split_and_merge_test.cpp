// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "detector/split_and_merge.hpp"

#include <gtest/gtest.h>

#include "tests/detector/part_fixtures.hpp"

namespace stairway::detect {
namespace {

TEST(SplitAndMerge, merges_cells_of_different_sizes) {
  scan::PointCloud cloud;
  test::add_rectangle(cloud, {0, 0, 0.05}, {0.64, 0, 0}, {0, 0.32, 0}, 0.01);
  test::add_rectangle(cloud, {0.66, 0.01, 0.06}, {0, 0, 0.2}, {0, 0.3, 0}, 0.01);  // spoils the large cell about it
  const std::vector<PlaneRegion> regions = split_and_merge(cloud);
  ASSERT_FALSE(regions.empty());
  const Eigen::Vector3d& centroid = regions.front().axes.centroid;
  EXPECT_NEAR(centroid.z(), 0.05, 0.005);
  EXPECT_NEAR(centroid.x(), 0.32, 0.03) << "both cells of the floor";
}

TEST(SplitAndMerge, takes_cells_of_the_smallest_size_too) {
  scan::PointCloud cloud;
  test::add_rectangle(cloud, {0.001, 0.001, 0.02}, {0.3, 0, 0}, {0, 0.3, 0}, 0.01);
  EXPECT_EQ(split_and_merge(cloud, {.max_leaf_m = 0.04, .min_leaf_m = 0.04}).size(), 1U);
}

TEST(SplitAndMerge, leaves_out_cells_with_a_point_off_their_plane) {
  scan::PointCloud cloud;
  test::add_rectangle(cloud, {0.01, 0.01, 0.02}, {0.3, 0, 0}, {0, 0.3, 0}, 0.01);
  const SplitAndMergeOptions one_size{.max_leaf_m = 0.32, .min_leaf_m = 0.32};
  EXPECT_EQ(split_and_merge(cloud, one_size).size(), 1U);
  cloud.points.emplace_back(0.15F, 0.15F, 0.2F);
  EXPECT_TRUE(split_and_merge(cloud, one_size).empty());
}

TEST(SplitAndMerge, does_not_creep_around_a_bend) {
  scan::PointCloud cloud;  // a quarter of a pipe with a radius of 1 m
  for (int i = 0; i <= 150; ++i)
    for (int k = 0; k <= 50; ++k) {
      const double angle = i * M_PI / 300;
      cloud.points.emplace_back(Eigen::Vector3d(std::cos(angle), 0.012 * k, std::sin(angle)).cast<float>());
    }
  for (const PlaneRegion& region : split_and_merge(cloud)) EXPECT_LT(region.points.size(), 0.6 * 151 * 51);
}

}  // namespace
}  // namespace stairway::detect
