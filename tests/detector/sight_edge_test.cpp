// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "detector/sight_edge.hpp"

#include <gtest/gtest.h>

namespace stairway::detect {
namespace {

TEST(SightEdge, lies_between_the_last_crossing_on_and_the_first_beyond) {
  std::vector<Crossing> crossings{{0.4, false}, {0.1, true}, {0.3, false}, {0.2, true}};
  ASSERT_TRUE(edge_between(crossings));
  EXPECT_DOUBLE_EQ(edge_between(crossings)->place, 0.25);
}

TEST(SightEdge, bears_a_crossing_on_the_wrong_side) {
  std::vector<Crossing> crossings{{0.0, true}, {0.1, true},  {0.15, false}, {0.2, true},
                                  {0.3, true}, {0.4, false}, {0.5, false},  {0.6, false}};
  ASSERT_TRUE(edge_between(crossings));
  EXPECT_DOUBLE_EQ(edge_between(crossings)->place, 0.35);
}

TEST(SightEdge, lies_amid_splits_that_are_equally_good) {
  std::vector<Crossing> crossings{{0.0, true},  {0.1, true},  {0.2, false}, {0.3, true},
                                  {0.4, false}, {0.5, false}, {0.6, false}, {0.7, false}};
  ASSERT_TRUE(edge_between(crossings));
  EXPECT_DOUBLE_EQ(edge_between(crossings)->place, 0.25);
}

TEST(SightEdge, is_the_less_certain_the_wider_the_gap) {
  std::vector<Crossing> near{{0.0, true}, {0.1, true}, {0.2, false}, {0.3, false}};
  std::vector<Crossing> wide{{0.0, true}, {0.1, true}, {0.5, false}, {0.6, false}};
  EXPECT_LT(edge_between(near)->sigma, 0.5 * edge_between(wide)->sigma);
}

TEST(SightEdge, is_not_guessed_from_few_like_or_mixed_crossings) {
  std::vector<Crossing> few{{0.1, true}, {0.2, true}, {0.3, false}};
  EXPECT_FALSE(edge_between(few));
  std::vector<Crossing> alike{{0.1, true}, {0.2, true}, {0.3, true}, {0.4, true}};
  EXPECT_FALSE(edge_between(alike));
  std::vector<Crossing> beyond{{0.1, false}, {0.2, false}, {0.3, false}, {0.4, false}};
  EXPECT_FALSE(edge_between(beyond));
  std::vector<Crossing> mixed{{0.1, false}, {0.2, true}, {0.3, false}, {0.4, true}, {0.5, false}, {0.6, true}};
  EXPECT_FALSE(edge_between(mixed));
  std::vector<Crossing> reversed{{0.1, false}, {0.2, false}, {0.3, true}, {0.4, true}};
  EXPECT_FALSE(edge_between(reversed));
}

}  // namespace
}  // namespace stairway::detect
