// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "detector/fragment_merging.hpp"

#include <gtest/gtest.h>

#include "tests/detector/part_fixtures.hpp"

namespace stairway::detect {
namespace {

struct Pieces {
  scan::PointCloud cloud;
  std::vector<PlaneRegion> regions;

  void add(const Eigen::Vector3d& corner, const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
    const auto first = static_cast<std::uint32_t>(cloud.points.size());
    test::add_rectangle(cloud, corner, a, b, 0.01);
    std::vector<std::uint32_t> points;
    for (auto i = first; i < cloud.points.size(); ++i) points.push_back(i);
    regions.push_back(make_region(cloud.points, points, {-1, 0, 0.5}));
  }
  std::vector<PlaneRegion> merged() const { return merge_fragments(cloud, regions, {}); }
};

TEST(FragmentMerging, joins_a_riser_torn_by_a_post) {
  Pieces pieces;
  pieces.add({2, -0.6, 0}, {0, 0.5, 0}, {0, 0, 0.17});
  pieces.add({2, 0.0, 0}, {0, 0.6, 0}, {0, 0, 0.17});
  const std::vector<PlaneRegion> regions = pieces.merged();
  ASSERT_EQ(regions.size(), 1U);
  EXPECT_EQ(regions[0].points.size(), pieces.cloud.points.size());
}

TEST(FragmentMerging, joins_the_pieces_of_wide_risers_all_over_a_building) {
  constexpr int kRisers = 12;
  Pieces pieces;
  for (int piece = 0; piece < 4; ++piece)  // the pieces of one riser are far apart in the list
    for (int riser = 0; riser < kRisers; ++riser)
      pieces.add({-20.0 + 3.5 * riser, 1.1 * (piece * 3 % 4) - 7.0 * (riser % 3), 0}, {0, 1.0, 0}, {0, 0, 0.17});
  const std::vector<PlaneRegion> regions = pieces.merged();
  ASSERT_EQ(regions.size(), static_cast<std::size_t>(kRisers));
  for (const PlaneRegion& region : regions)
    EXPECT_EQ(region.points.size(), pieces.cloud.points.size() / static_cast<std::size_t>(kRisers));
}

TEST(FragmentMerging, keeps_neighbouring_steps_apart) {
  Pieces pieces;
  pieces.add({2.00, -0.6, 0.00}, {0, 1.2, 0}, {0, 0, 0.17});
  pieces.add({2.29, -0.6, 0.17}, {0, 1.2, 0}, {0, 0, 0.17});
  pieces.add({2.00, -0.6, 0.17}, {0, 1.2, 0}, {0.29, 0, 0});
  pieces.add({2.29, -0.6, 0.34}, {0, 1.2, 0}, {0.29, 0, 0});
  EXPECT_EQ(pieces.merged().size(), 4U);
}

TEST(FragmentMerging, does_not_build_a_wall_or_a_floor) {
  Pieces wall;
  wall.add({2, -0.6, 0.00}, {0, 1.2, 0}, {0, 0, 0.2});
  wall.add({2, -0.6, 0.21}, {0, 1.2, 0}, {0, 0, 0.2});
  EXPECT_EQ(wall.merged().size(), 2U);
  Pieces floor;
  floor.add({2.00, -0.6, 0}, {0, 1.2, 0}, {0.3, 0, 0});
  floor.add({2.31, -0.6, 0}, {0, 1.2, 0}, {0.3, 0, 0});
  EXPECT_EQ(floor.merged().size(), 2U);
}

TEST(FragmentMerging, can_be_switched_off) {
  Pieces pieces;
  pieces.add({2, -0.6, 0}, {0, 0.5, 0}, {0, 0, 0.17});
  pieces.add({2, 0.0, 0}, {0, 0.6, 0}, {0, 0, 0.17});
  EXPECT_EQ(merge_fragments(pieces.cloud, pieces.regions, {}, {.enabled = false}).size(), 2U);
}

}  // namespace
}  // namespace stairway::detect
