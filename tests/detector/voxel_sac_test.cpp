// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "detector/voxel_sac.hpp"

#include <gtest/gtest.h>

#include "tests/detector/part_fixtures.hpp"

namespace stairway::detect {
namespace {

std::vector<PlaneRegion> segment(const scan::PointCloud& cloud, const VoxelSacOptions& options = {}) {
  return voxel_sac(cloud, estimate_normals(cloud), options);
}

scan::PointCloud two_tables(double gap_m) {
  scan::PointCloud cloud;
  test::add_rectangle(cloud, {0, 0, 0.7}, {0.6, 0, 0}, {0, 0.6, 0}, 0.012);
  test::add_rectangle(cloud, {0.6 + gap_m, 0, 0.7}, {0.6, 0, 0}, {0, 0.6, 0}, 0.012);
  return cloud;
}

TEST(VoxelSac, spans_a_gap_of_less_than_a_cell) { EXPECT_EQ(segment(two_tables(0.12)).size(), 1U); }

TEST(VoxelSac, stops_at_a_gap_of_more_than_two_cells) { EXPECT_EQ(segment(two_tables(0.7)).size(), 2U); }

TEST(VoxelSac, finds_a_plane_in_a_cell_that_holds_other_points_too) {
  scan::PointCloud cloud;
  test::add_rectangle(cloud, {0.01, 0.01, 0.08}, {0.14, 0, 0}, {0, 0.14, 0}, 0.01);
  const std::size_t in_plane = cloud.points.size();
  for (int i = 0; i < 30; ++i) cloud.points.emplace_back(0.005F * static_cast<float>(i), 0.02F, 0.12F);
  const VoxelSacOptions one_size{.max_leaf_m = 0.16, .min_leaf_m = 0.16};
  const SurfaceNormals upward{std::vector<Eigen::Vector3f>(cloud.points.size(), Eigen::Vector3f::UnitZ()),
                              std::vector<float>(cloud.points.size(), 0.0F)};
  const std::vector<PlaneRegion> regions = voxel_sac(cloud, upward, one_size);
  ASSERT_EQ(regions.size(), 1U);
  EXPECT_EQ(regions[0].points.size(), in_plane);
}

TEST(VoxelSac, leaves_out_regions_that_are_too_small) {
  const scan::PointCloud cloud = two_tables(0.36);
  VoxelSacOptions options;
  options.min_points = 100000;
  EXPECT_TRUE(segment(cloud, options).empty());
}

}  // namespace
}  // namespace stairway::detect
