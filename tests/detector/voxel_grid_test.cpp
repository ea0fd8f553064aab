// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "detector/voxel_grid.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace stairway::detect {
namespace {

TEST(VoxelGrid, keeps_one_centroid_per_cell) {
  scan::PointCloud cloud;
  cloud.points = {{0.001F, 0.001F, 0.001F}, {0.003F, 0.003F, 0.003F}, {0.015F, 0.001F, 0.001F}};
  const scan::PointCloud thinned = voxel_centroids(cloud, 0.01);
  ASSERT_EQ(thinned.points.size(), 2U);
  EXPECT_LT((thinned.points[0] - Eigen::Vector3f::Constant(0.002F)).norm(), 1e-6F);
}

TEST(VoxelGrid, does_not_depend_on_the_order_of_points) {
  std::mt19937 engine(3);
  std::uniform_real_distribution<float> place(-1.0F, 1.0F);
  scan::PointCloud cloud;
  for (int i = 0; i < 4000; ++i) cloud.points.emplace_back(place(engine), place(engine), place(engine));
  const scan::PointCloud before = voxel_centroids(cloud, 0.2);
  std::shuffle(cloud.points.begin(), cloud.points.end(), engine);
  const scan::PointCloud after = voxel_centroids(cloud, 0.2);
  ASSERT_EQ(before.points.size(), after.points.size());
  for (std::size_t i = 0; i < before.points.size(); ++i) EXPECT_LT((before.points[i] - after.points[i]).norm(), 1e-5F);
}

TEST(VoxelGrid, keeps_the_sensor_and_survives_an_empty_cloud) {
  scan::PointCloud cloud;
  cloud.sensor_origin = Eigen::Vector3f(1, 2, 3);
  const scan::PointCloud thinned = voxel_centroids(cloud, 0.01);
  EXPECT_TRUE(thinned.points.empty());
  EXPECT_EQ(thinned.sensor_origin, cloud.sensor_origin);
}

}  // namespace
}  // namespace stairway::detect
