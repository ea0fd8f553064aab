// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "detector/cell_groups.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <random>
#include <set>

namespace stairway::detect {
namespace {

std::vector<Eigen::Vector3f> random_points(int count, float span) {
  std::mt19937 engine(7);
  std::uniform_real_distribution<float> place(-span, span);
  std::vector<Eigen::Vector3f> points;
  for (int i = 0; i < count; ++i) points.emplace_back(place(engine), place(engine), place(engine));
  return points;
}

TEST(CellGroups, put_every_point_into_exactly_one_cell) {
  const auto points = random_points(5000, 3.0F);
  const CellGroups groups = group_by_cell(points, 0.1);
  std::set<std::uint32_t> seen(groups.order.begin(), groups.order.end());
  EXPECT_EQ(seen.size(), points.size());
  EXPECT_EQ(groups.starts.back(), points.size());
}

TEST(CellGroups, hold_points_of_one_cube_only) {
  const auto points = random_points(5000, 3.0F);
  const CellGroups groups = group_by_cell(points, 0.25);
  std::set<std::tuple<int, int, int>> cells;
  for (std::size_t cell = 0; cell < groups.size(); ++cell) {
    std::set<std::tuple<int, int, int>> here;
    for (const std::uint32_t i : groups[cell]) {
      const Eigen::Vector3f c = (points[i] / 0.25F).array().floor();
      here.emplace(static_cast<int>(c.x()), static_cast<int>(c.y()), static_cast<int>(c.z()));
    }
    ASSERT_EQ(here.size(), 1U);
    EXPECT_TRUE(cells.insert(*here.begin()).second) << "a cube was split";
  }
}

TEST(CellGroups, leave_out_points_that_are_nowhere) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const float inf = std::numeric_limits<float>::infinity();
  const std::vector<Eigen::Vector3f> points{{0, 0, 0},   {nan, 0, 0},  {0, nan, 0},  {0, 0, nan},
                                            {inf, 0, 0}, {0, 0, -inf}, {2e4F, 0, 0}, {1, 1, 1}};
  const CellGroups groups = group_by_cell(points, 0.1);
  EXPECT_EQ(groups.order.size(), 2U);
  EXPECT_EQ(groups.size(), 2U);
}

TEST(CellRows, hold_the_cells_within_reach_and_no_others) {
  const auto points = random_points(3000, 1.0F);
  const CellGroups groups = group_by_cell(points, 0.1);
  const auto place = [&](std::size_t cell) {
    return (points[groups[cell].front()].cast<double>() / 0.1).array().floor().eval();
  };
  for (const int reach : {1, 3, kCellMargin}) {
    SCOPED_TRACE(reach);
    CellRows rows(groups, reach);
    for (std::size_t cell = 0; cell < groups.size(); cell += 11) {
      std::set<std::size_t> found;
      rows.around(cell, [&](std::size_t first, std::size_t last) {
        for (; first < last; ++first) EXPECT_TRUE(found.insert(first).second);
      });
      std::set<std::size_t> expected;
      for (std::size_t other = 0; other < groups.size(); ++other)
        if ((place(other) - place(cell)).abs().maxCoeff() <= reach) expected.insert(other);
      EXPECT_EQ(found, expected);
    }
  }
}

TEST(CellGroups, of_nothing_are_none) {
  EXPECT_EQ(group_by_cell({}, 0.1).size(), 0U);
  const std::vector<Eigen::Vector3f> nowhere{Eigen::Vector3f::Constant(std::numeric_limits<float>::quiet_NaN())};
  EXPECT_EQ(group_by_cell(nowhere, 0.1).size(), 0U);
}

}  // namespace
}  // namespace stairway::detect
