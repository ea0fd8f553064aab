// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "detector/region_growing.hpp"

#include <gtest/gtest.h>

#include <random>
#include <set>

#include "tests/detector/part_fixtures.hpp"

namespace stairway::detect {
namespace {

std::vector<PlaneRegion> segment(const scan::PointCloud& cloud, const RegionGrowingOptions& options = {}) {
  return grow_regions(cloud, estimate_normals(cloud), options);
}

scan::PointCloud step_and_floor() {
  scan::PointCloud cloud;
  test::add_rectangle(cloud, {1.0, -0.6, 0.0}, {1.0, 0, 0}, {0, 1.2, 0}, 0.015);   // floor
  test::add_rectangle(cloud, {2.0, -0.6, 0.0}, {0, 0, 0.17}, {0, 1.2, 0}, 0.015);  // riser
  test::add_rectangle(cloud, {2.0, -0.6, 0.17}, {0.3, 0, 0}, {0, 1.2, 0}, 0.015);  // tread
  cloud.sensor_origin = Eigen::Vector3f(0, 0, 0.5F);
  return cloud;
}

const PlaneRegion* region_like(const std::vector<PlaneRegion>& regions, const Eigen::Vector3d& normal,
                               const Eigen::Vector3d& near) {
  for (const PlaneRegion& region : regions)
    if (std::abs(region.axes.normal().dot(normal)) > 0.97 && (region.axes.centroid - near).norm() < 0.15)
      return &region;
  return nullptr;
}

TEST(RegionGrowing, separates_floor_riser_and_tread) {
  const std::vector<PlaneRegion> regions = segment(step_and_floor());
  EXPECT_TRUE(region_like(regions, Eigen::Vector3d::UnitZ(), {1.5, 0, 0}));
  EXPECT_TRUE(region_like(regions, Eigen::Vector3d::UnitX(), {2.0, 0, 0.085}));
  EXPECT_TRUE(region_like(regions, Eigen::Vector3d::UnitZ(), {2.15, 0, 0.17}));
}

TEST(RegionGrowing, gives_no_point_to_two_regions) {
  std::set<std::uint32_t> taken;
  for (const PlaneRegion& region : segment(step_and_floor()))
    for (const std::uint32_t point : region.points) EXPECT_TRUE(taken.insert(point).second);
}

TEST(RegionGrowing, stops_at_a_gap_wider_than_the_neighbourhood) {
  scan::PointCloud cloud;
  test::add_rectangle(cloud, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, 0.02);
  test::add_rectangle(cloud, {1.5, 0, 0}, {1, 0, 0}, {0, 1, 0}, 0.02);
  EXPECT_EQ(segment(cloud).size(), 2U);
}

TEST(RegionGrowing, leaves_out_regions_that_are_too_small) {
  scan::PointCloud cloud;
  test::add_rectangle(cloud, {0, 0, 0}, {0.1, 0, 0}, {0, 0.08, 0}, 0.02);  // 6 x 5 points
  ASSERT_EQ(cloud.points.size(), 30U);
  EXPECT_TRUE(segment(cloud).empty()) << "more than 30 points are asked for";
  EXPECT_EQ(segment(cloud, {.min_points = 29}).size(), 1U);
}

TEST(RegionGrowing, keeps_parallel_planes_apart) {
  scan::PointCloud cloud;
  test::add_rectangle(cloud, {0, 0, 0.0}, {1, 0, 0}, {0, 1, 0}, 0.02);
  test::add_rectangle(cloud, {0, 0, 0.17}, {1, 0, 0}, {0, 1, 0}, 0.02);
  EXPECT_EQ(segment(cloud).size(), 2U);
}

TEST(RegionGrowing, says_which_option_is_wrong) {
  EXPECT_EQ(RegionGrowingOptions{}.problem(), "");
  EXPECT_NE(RegionGrowingOptions{.num_neighbours = 2}.problem(), "");
  EXPECT_NE(RegionGrowingOptions{.max_normal_angle_rad = 2.0}.problem(), "");
  EXPECT_NE(RegionGrowingOptions{.max_plane_distance_m = 0.0}.problem(), "");
}

}  // namespace
}  // namespace stairway::detect
