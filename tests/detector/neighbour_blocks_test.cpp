// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "detector/neighbour_blocks.hpp"

#include <gtest/gtest.h>

#include <random>
#include <set>

namespace stairway::detect {
namespace {

std::vector<Eigen::Vector3f> random_points(int count, float span_m) {
  std::mt19937 engine(17);
  std::uniform_real_distribution<float> place(-span_m, span_m);
  std::vector<Eigen::Vector3f> points;
  for (int i = 0; i < count; ++i) points.emplace_back(place(engine), place(engine), place(engine));
  return points;
}

// What the header promises, found the slow way.
std::set<std::uint32_t> expected_block(const std::vector<Eigen::Vector3f>& points, std::size_t point,
                                       std::size_t count) {
  std::set<std::uint32_t> block;
  for (const double leaf_m : {0.02, 0.04, 0.08, 0.16}) {
    const auto cell_of = [&](std::size_t i) { return (points[i].cast<double>() / leaf_m).array().floor().eval(); };
    block.clear();
    for (std::size_t other = 0; other < points.size(); ++other)
      if ((cell_of(other) - cell_of(point)).abs().maxCoeff() <= 1.0) block.insert(static_cast<std::uint32_t>(other));
    if (block.size() > count) return block;
  }
  return block;
}

TEST(NeighbourBlocks, are_the_smallest_that_hold_enough_points) {
  for (const float span_m : {0.05F, 0.3F, 1.0F, 4.0F}) {
    SCOPED_TRACE(span_m);
    const std::vector<Eigen::Vector3f> points = random_points(500, span_m);
    const NeighbourBlocks blocks(points, 12);
    for (std::size_t point = 0; point < points.size(); point += 7) {
      std::set<std::uint32_t> found;
      blocks.for_each_point(blocks.block_of(point), [&](std::uint32_t other) { found.insert(other); });
      EXPECT_EQ(found, expected_block(points, point, 12));
    }
  }
}

TEST(NeighbourBlocks, of_nothing_are_harmless) { EXPECT_EQ(NeighbourBlocks({}, 12).size(), 1U); }

TEST(NeighbourBlocks, of_a_point_that_is_nowhere_hold_nobody) {
  std::vector<Eigen::Vector3f> points = random_points(50, 0.1F);
  points[3].x() = std::numeric_limits<float>::quiet_NaN();
  const NeighbourBlocks blocks(points, 12);
  blocks.for_each_point(blocks.block_of(3), [](std::uint32_t) { FAIL(); });
}

}  // namespace
}  // namespace stairway::detect
