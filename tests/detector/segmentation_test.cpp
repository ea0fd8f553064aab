// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "detector/segmentation.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <limits>
#include <random>
#include <set>

#include "detector/levelling.hpp"
#include "tests/detector/part_fixtures.hpp"

namespace stairway::detect {
namespace {

struct Wanted {
  Eigen::Vector3d normal;
  Eigen::Vector3d centroid;
};

class EveryMethod : public testing::TestWithParam<SegmentationMethod> {
 protected:
  std::vector<PlaneRegion> found(const scan::PointCloud& cloud) const { return segment(cloud, {.method = GetParam()}); }
};

std::string name_of(const testing::TestParamInfo<SegmentationMethod>& method) {
  const std::array names{"RegionGrowing", "SplitAndMerge", "VoxelSac"};
  return names.at(static_cast<std::size_t>(method.param));
}

INSTANTIATE_TEST_SUITE_P(Segmentation, EveryMethod,
                         testing::Values(SegmentationMethod::RegionGrowing, SegmentationMethod::SplitAndMerge,
                                         SegmentationMethod::VoxelSac),
                         name_of);

// The largest region with this normal and centroid.
const PlaneRegion* region_like(const std::vector<PlaneRegion>& regions, const Wanted& wanted) {
  const PlaneRegion* best = nullptr;
  for (const PlaneRegion& region : regions) {
    if (std::abs(region.axes.normal().dot(wanted.normal)) < 0.97) continue;
    if ((region.axes.centroid - wanted.centroid).norm() > 0.1) continue;
    if (!best || region.points.size() > best->points.size()) best = &region;
  }
  return best;
}

void add_noise(scan::PointCloud& cloud, float sigma_m) {
  std::mt19937 engine(3);
  std::normal_distribution<float> noise(0.0F, sigma_m);
  for (Eigen::Vector3f& p : cloud.points) p += Eigen::Vector3f(noise(engine), noise(engine), noise(engine));
}

// A floor and a ramp of 40 degrees that begins at its edge.
scan::PointCloud floor_and_ramp() {
  scan::PointCloud cloud;
  test::add_rectangle(cloud, {0, -0.5, 0}, {1, 0, 0}, {0, 1, 0}, 0.012);
  test::add_rectangle(cloud, {1, -0.5, 0}, {0.766, 0, 0.643}, {0, 1, 0}, 0.012);
  cloud.sensor_origin = Eigen::Vector3f(-1, 0, 1);
  return cloud;
}
const Wanted kFloor{{0, 0, 1}, {0.5, 0, 0}};
const Wanted kRamp{{-0.643, 0, 0.766}, {1.383, 0, 0.3215}};

// Floor, riser and tread, the borders of cells nowhere near them.
scan::PointCloud step() {
  scan::PointCloud cloud;
  test::add_rectangle(cloud, {1.03, -0.6, 0.01}, {1.0, 0, 0}, {0, 1.2, 0}, 0.012);
  test::add_rectangle(cloud, {2.03, -0.6, 0.01}, {0, 0, 0.18}, {0, 1.2, 0}, 0.012);
  test::add_rectangle(cloud, {2.03, -0.6, 0.19}, {0.3, 0, 0}, {0, 1.2, 0}, 0.012);
  cloud.sensor_origin = Eigen::Vector3f(0, 0, 1.0F);
  return cloud;
}
const Wanted kStep[] = {{{0, 0, 1}, {1.53, 0, 0.01}}, {{1, 0, 0}, {2.03, 0, 0.1}}, {{0, 0, 1}, {2.18, 0, 0.19}}};

TEST_P(EveryMethod, tells_a_floor_from_a_ramp) {
  const std::vector<PlaneRegion> regions = found(floor_and_ramp());
  for (const Wanted& wanted : {kFloor, kRamp}) {
    const PlaneRegion* region = region_like(regions, wanted);
    ASSERT_TRUE(region);
    EXPECT_GT(region->points.size(), 5500U) << "of about 7000";
    EXPECT_GT(region->axes.normal().dot(wanted.normal), 0.99) << "towards the sensor, and with the plane's own slope";
  }
}

TEST_P(EveryMethod, tells_floor_riser_and_tread_apart) {
  const std::vector<PlaneRegion> regions = found(step());
  for (const Wanted& wanted : kStep) EXPECT_TRUE(region_like(regions, wanted));
}

TEST_P(EveryMethod, bears_the_noise_of_the_scanner) {
  scan::PointCloud cloud = floor_and_ramp();
  add_noise(cloud, 0.006F);
  const std::vector<PlaneRegion> regions = found(cloud);
  EXPECT_TRUE(region_like(regions, kFloor));
  EXPECT_TRUE(region_like(regions, kRamp));
}

TEST_P(EveryMethod, gives_no_point_to_two_regions) {
  scan::PointCloud cloud = step();
  add_noise(cloud, 0.006F);
  std::set<std::uint32_t> taken;
  for (const PlaneRegion& region : found(cloud)) {
    EXPECT_GT(region.points.size(), 30U);
    for (const std::uint32_t point : region.points) {
      EXPECT_LT(point, cloud.points.size());
      EXPECT_TRUE(taken.insert(point).second);
    }
  }
}

TEST_P(EveryMethod, gives_the_same_regions_for_shuffled_points) {
  scan::PointCloud cloud = floor_and_ramp();
  std::shuffle(cloud.points.begin(), cloud.points.end(), std::mt19937(5));
  const std::vector<PlaneRegion> regions = found(cloud);
  EXPECT_TRUE(region_like(regions, kFloor));
  EXPECT_TRUE(region_like(regions, kRamp));
}

TEST_P(EveryMethod, turns_with_the_scene) {
  for (const double angle : {0.4, 1.3, -2.5}) {
    SCOPED_TRACE(angle);
    const Eigen::Isometry3d turn =
        Eigen::Translation3d(0.3, -1.2, 0.05) * Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitZ());
    const std::vector<PlaneRegion> regions = found(transformed(floor_and_ramp(), turn));
    for (const Wanted& wanted : {kFloor, kRamp})
      EXPECT_TRUE(region_like(regions, {turn.linear() * wanted.normal, turn * wanted.centroid}));
  }
}

TEST_P(EveryMethod, finds_nothing_where_nothing_is) {
  EXPECT_TRUE(found({}).empty());
  scan::PointCloud few;
  few.points = {{0, 0, 0}, {1, 0, 0}};
  EXPECT_TRUE(found(few).empty());
  scan::PointCloud line;
  for (int i = 0; i < 25; ++i) line.points.emplace_back(0.01F * static_cast<float>(i), 0.0F, 0.0F);
  EXPECT_TRUE(found(line).empty());
  scan::PointCloud sparse;
  test::add_rectangle(sparse, {0, 0, 0}, {20, 0, 0}, {0, 20, 0}, 2.0);
  EXPECT_TRUE(found(sparse).empty()) << "2 m between points";
}

TEST_P(EveryMethod, survives_points_on_top_of_each_other) {
  scan::PointCloud cloud;
  cloud.points.assign(500, Eigen::Vector3f(1, 2, 3));
  for (const PlaneRegion& region : found(cloud)) EXPECT_TRUE(region.axes.axes.allFinite());
}

TEST(Segmentation, names_the_stages_that_it_goes_through) {
  const auto stages = [](SegmentationMethod method) {
    std::vector<std::string> heard;
    segment(step(), {.method = method}, [&](std::string_view stage) { heard.emplace_back(stage); });
    return heard;
  };
  EXPECT_EQ(stages(SegmentationMethod::RegionGrowing), (std::vector<std::string>{"normals", "segmentation"}));
  EXPECT_EQ(stages(SegmentationMethod::VoxelSac), (std::vector<std::string>{"normals", "segmentation"}));
  EXPECT_EQ(stages(SegmentationMethod::SplitAndMerge), (std::vector<std::string>{"segmentation"}));
}

TEST(Segmentation, says_which_option_is_wrong) {
  EXPECT_EQ(SegmentationOptions{}.problem(), "");
  EXPECT_NE(SegmentationOptions{.normals = {.radius_m = 0.0}}.problem(), "");
  EXPECT_NE(SegmentationOptions{.region_growing = {.min_points = 0}}.problem(), "");
  const SplitAndMergeOptions wrong_splits[] = {{.max_leaf_m = 0.02},
                                               {.min_leaf_m = 0.0},
                                               {.min_leaf_points = 2},
                                               {.max_leaf_distance_m = 0.0},
                                               {.max_normal_angle_rad = 2.0},
                                               {.max_plane_distance_m = -1.0},
                                               {.min_points = 2}};
  for (const SplitAndMergeOptions& wrong : wrong_splits)
    EXPECT_NE(SegmentationOptions{.split_and_merge = wrong}.problem(), "");
  const VoxelSacOptions wrong_sacs[] = {{.max_leaf_m = 0.02},
                                        {.min_leaf_m = 0.0},
                                        {.iterations = 0},
                                        {.min_inlier_share = 1.5},
                                        {.max_plane_distance_m = 0.0},
                                        {.max_normal_angle_rad = 2.0},
                                        {.min_cell_points = 0},
                                        {.min_points = 2},
                                        {.max_plane_distance_m = std::numeric_limits<double>::quiet_NaN()}};
  for (const VoxelSacOptions& wrong : wrong_sacs) EXPECT_NE(SegmentationOptions{.voxel_sac = wrong}.problem(), "");
}

}  // namespace
}  // namespace stairway::detect
