// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "detector/level_strips.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/detector/part_fixtures.hpp"
#include "tools/sim/random.hpp"

namespace stairway::detect {
namespace {

constexpr double kHeight_m = 0.18;
constexpr double kDepth_m = 0.29;
constexpr double kWidth_m = 1.2;
constexpr int kTreads = 3;

/// What a descent along x shows of its treads: strips of 3 cm before each nosing, blurred by 6 mm in height.
scan::PointCloud strips() {
  scan::PointCloud cloud;
  sim::Random random{7};
  for (int i = 1; i <= kTreads; ++i)
    test::add_rectangle(cloud, {1.0 + i * kDepth_m - 0.03, -0.5 * kWidth_m, -i * kHeight_m}, {0.03, 0, 0},
                        {0, kWidth_m, 0}, 0.006);
  for (Eigen::Vector3f& p : cloud.points) p.z() += static_cast<float>(0.006 * random.normal());
  cloud.sensor_origin = Eigen::Vector3f(0, 0, 0.5F);
  return cloud;
}

TEST(LevelStrips, are_treads_that_end_at_their_nosings) {
  std::vector<StairPart> found = find_level_strips(strips(), {}, {});
  ASSERT_EQ(found.size(), static_cast<std::size_t>(kTreads));
  std::sort(found.begin(), found.end(),
            [](const StairPart& a, const StairPart& b) { return a.centroid.z() > b.centroid.z(); });
  for (int i = 0; i < kTreads; ++i) {
    const StairPart& tread = found[static_cast<std::size_t>(i)];
    EXPECT_EQ(tread.kind, StairPart::Kind::Tread);
    EXPECT_NEAR(tread.centroid.z(), -(i + 1) * kHeight_m, 0.002);
    EXPECT_NEAR(std::max(tread.front.x(), tread.back.x()), 1.0 + (i + 1) * kDepth_m, 0.008);
    EXPECT_NEAR(tread.width(), kWidth_m, 0.05);
  }
}

TEST(LevelStrips, have_region_numbers_of_their_own) {
  const std::vector<PlaneRegion> others(5);
  std::vector<std::size_t> numbers;
  for (const StairPart& tread : find_level_strips(strips(), others, {})) numbers.push_back(tread.region);
  EXPECT_EQ(numbers, (std::vector<std::size_t>{5, 6, 7}));
}

TEST(LevelStrips, are_not_looked_for_above_the_floor) {
  scan::PointCloud cloud = strips();
  for (Eigen::Vector3f& p : cloud.points) p.z() += 1.0F;
  EXPECT_TRUE(find_level_strips(cloud, {}, {}).empty());
  EXPECT_TRUE(find_level_strips({}, {}, {}).empty());
}

TEST(LevelStrips, are_no_slices_of_walls_and_ghosts) {
  scan::PointCloud cloud;
  test::add_rectangle(cloud, {2.0, -1.0, -1.0}, {0, 2.0, 0}, {0, 0, 0.9}, 0.006);
  sim::Random random{8};
  for (int i = 0; i < 20000; ++i)
    cloud.points.emplace_back(static_cast<float>(random.uniform(1.0, 1.1)),
                              static_cast<float>(random.uniform(-0.6, 0.6)),
                              static_cast<float>(random.uniform(-1.0, -0.1)));
  EXPECT_TRUE(find_level_strips(cloud, {}, {}).empty());
}

TEST(LevelStrips, leave_out_what_a_region_tells_better) {
  const scan::PointCloud cloud = strips();
  std::vector<std::uint32_t> highest;
  for (std::uint32_t i = 0; i < cloud.points.size(); ++i)
    if (cloud.points[i].z() > -1.5 * kHeight_m) highest.push_back(i);
  PlaneRegion wide = make_region(cloud.points, highest, Eigen::Vector3d::UnitZ());
  wide.axes.variances[1] = 0.1 * 0.1;
  EXPECT_EQ(find_level_strips(cloud, {wide}, {}).size(), static_cast<std::size_t>(kTreads - 1));
}

}  // namespace
}  // namespace stairway::detect
