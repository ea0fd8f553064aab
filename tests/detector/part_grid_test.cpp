// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "detector/part_grid.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "detector/graph_initialisation.hpp"
#include "detector/stair_graph.hpp"
#include "tests/detector/part_fixtures.hpp"

namespace stairway::detect {
namespace {

constexpr double kOneCell_m = 1e6;  // everything is near

/// Flights here and there in a building, with their risers out of order.
std::vector<StairPart> building(int flights) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> place(-8.0, 8.0);
  std::vector<StairPart> parts;
  for (int flight = 0; flight < flights; ++flight) {
    const StairModel model =
        test::make_model(0.17, 0.28, place(random), Eigen::Vector3d(place(random), place(random), 0.17));
    for (int number = 0; number < 6; ++number)
      parts.push_back(number % 2 == flight % 2 ? test::riser_of(model, number) : test::tread_of(model, number));
    parts.push_back(test::riser_of(model, 7));
    parts.push_back(test::riser_of(model, 8));
  }
  std::shuffle(parts.begin(), parts.end(), random);
  return test::with_regions(std::move(parts));
}

TEST(PartGrid, finds_all_that_is_near_once_and_in_order) {
  const std::vector<StairPart> parts = building(30);
  const PartGrid grid(parts, 0.7);
  std::vector<std::size_t> found;
  for (const double radius : {0.1, 1.0, 5.0})
    for (const StairPart& from : parts) {
      const Eigen::Vector2d place = from.centroid.head<2>();
      grid.around(place, radius, found);
      EXPECT_TRUE(std::is_sorted(found.begin(), found.end()));
      EXPECT_EQ(std::adjacent_find(found.begin(), found.end()), found.end());
      for (std::size_t i = 0; i < parts.size(); ++i) {
        if ((parts[i].centroid.head<2>() - place).norm() <= radius) {
          EXPECT_TRUE(std::binary_search(found.begin(), found.end(), i));
        }
      }
      for (const std::size_t i : found)
        EXPECT_LE((parts[i].centroid.head<2>() - place).lpNorm<Eigen::Infinity>(), radius + 0.7);
    }
}

TEST(PartGrid, of_nothing_finds_nothing) {
  std::vector<std::size_t> found{3};
  PartGrid(std::vector<StairPart>{}, 1.0).around({0.0, 0.0}, 10.0, found);
  EXPECT_TRUE(found.empty());
}

TEST(PartGrid, leaves_the_initialisations_as_all_pairs_would_give_them) {
  const std::vector<StairPart> parts = building(50);
  const std::vector<Initialisation> starts = initialise_graphs(parts);
  ASSERT_GT(starts.size(), 50U);
  std::size_t next = 0;
  for (std::size_t i = 0; i < parts.size(); ++i)
    for (std::size_t k = 0; k < parts.size(); ++k)
      for (const Initialisation& start : initialise_graphs({parts[i], parts[k]})) {
        if (i == k || start.parts[0] != 0) continue;
        ASSERT_LT(next, starts.size());
        EXPECT_EQ(starts[next].parts, (std::array{i, k}));
        EXPECT_EQ(starts[next].model.nosing, start.model.nosing);
        EXPECT_EQ(starts[next].model.depth_m, start.model.depth_m);
        ++next;
      }
  EXPECT_EQ(next, starts.size());
}

TEST(PartGrid, leaves_the_graphs_as_a_search_of_all_parts_would_grow_them) {
  const std::vector<StairPart> parts = building(30);
  const PartGrid grid(parts, 1.0);
  const PartGrid everything(parts, kOneCell_m);
  std::size_t longest = 0;
  for (const Initialisation& start : initialise_graphs(parts)) {
    const StairGraph graph = extend_graph(start.model, {-0.6, 0.6}, parts, grid, View::FromBelow);
    const StairGraph slow = extend_graph(start.model, {-0.6, 0.6}, parts, everything, View::FromBelow);
    ASSERT_EQ(graph.parts.size(), slow.parts.size());
    for (std::size_t i = 0; i < graph.parts.size(); ++i) EXPECT_EQ(graph.parts[i].part, slow.parts[i].part);
    longest = std::max(longest, graph.parts.size());
  }
  EXPECT_GE(longest, 6U);
}

}  // namespace
}  // namespace stairway::detect
