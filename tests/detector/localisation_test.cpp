// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "detector/localisation.hpp"

#include <gtest/gtest.h>

#include "tests/detector/part_fixtures.hpp"

namespace stairway::detect {
namespace {

FittedStairway fitted(int first, int last) {
  return {.model = test::make_model(0.17, 0.29), .sides = {-0.6, 0.6}, .first = first, .last = last};
}

TEST(Localisation, places_the_anchor_at_the_top_front_of_the_first_step) {
  const Stairway stairway = localise(fitted(0, 9));
  EXPECT_EQ(stairway.nosings.size(), 10U);
  EXPECT_LT((stairway.anchor - Eigen::Vector3d(2.0, 0.0, 0.17)).norm(), 1e-9);
  EXPECT_EQ(stairway.anchor_side, AnchorSide::Middle);
  EXPECT_NEAR(stairway.heading, 0.0, 1e-12);
  EXPECT_NEAR(stairway.nosings[0].left.y(), 0.6, 1e-12);
  EXPECT_NEAR(stairway.nosings[0].right.y(), -0.6, 1e-12);
  EXPECT_NEAR(stairway.pitch(), std::atan2(0.17, 0.29), 1e-12);
}

TEST(Localisation, anchors_the_stairway_at_the_end_where_a_railing_shows_that_it_is_whole) {
  FittedStairway stairway = fitted(0, 9);
  const auto expect_anchor = [&](AnchorSide side, double y) {
    const Stairway result = localise(stairway);
    EXPECT_EQ(result.anchor_side, side);
    EXPECT_NEAR(result.anchor.y(), y, 1e-12);
    EXPECT_EQ(result.railing_left, stairway.railing.left);
    EXPECT_EQ(result.railing_right, stairway.railing.right);
  };
  stairway.railing = {.left = true, .right = false};
  expect_anchor(AnchorSide::Left, 0.6);
  stairway.railing = {.left = false, .right = true};
  expect_anchor(AnchorSide::Right, -0.6);
  stairway.railing = {.left = true, .right = true};
  expect_anchor(AnchorSide::Middle, 0.0);
}

TEST(Localisation, continues_a_stairway_down_to_the_ground) {
  const Stairway stairway = localise(fitted(3, 9));
  EXPECT_EQ(stairway.nosings.size(), 10U);
  EXPECT_NEAR(stairway.nosings.front().left.z(), 0.17, 1e-9);
}

TEST(Localisation, does_not_invent_a_whole_storey) {
  const Stairway stairway = localise(fitted(15, 20));
  EXPECT_EQ(stairway.nosings.size(), 6U);
  EXPECT_NEAR(stairway.anchor.z(), 16 * 0.17, 1e-9);
}

// A flight of six steps to 1.02 m, and one that was seen from `first_z_m` on; it goes up to the left from its landing.
std::vector<FittedStairway> flights_about_a_landing(double x, double first_z_m) {
  FittedStairway lower = fitted(0, 5);
  FittedStairway upper = fitted(0, 3);
  upper.model.descent = -Eigen::Vector3d::UnitY();
  upper.model.nosing = {x, 0.6 + (first_z_m - 1.19) / 0.17 * 0.29, first_z_m};
  return {lower, upper};
}

TEST(Localisation, begins_a_flight_on_the_landing_of_another_one) {
  for (const double first_z_m : {1.19, 1.53}) {
    SCOPED_TRACE(first_z_m);
    std::vector<FittedStairway> flights = flights_about_a_landing(4.0, first_z_m);
    begin_on_landings(flights);
    EXPECT_NEAR(localise(flights[0]).nosings.front().left.z(), 0.17, 1e-9);
    EXPECT_NEAR(localise(flights[1]).nosings.front().left.z(), 1.19, 1e-9);
  }
}

TEST(Localisation, lets_a_flight_beside_another_one_begin_on_the_ground) {
  for (const double x : {6.0, 1.0}) {
    SCOPED_TRACE(x);
    std::vector<FittedStairway> flights = flights_about_a_landing(x, 1.19);
    begin_on_landings(flights);
    EXPECT_NEAR(localise(flights[1]).nosings.front().left.z(), 0.17, 1e-9);
  }
}

TEST(Localisation, drops_steps_below_the_ground) { EXPECT_EQ(localise(fitted(-2, 9)).nosings.size(), 10U); }

TEST(Localisation, keeps_one_of_two_descriptions_of_the_same_stairway) {
  FittedStairway good = fitted(0, 9);
  good.evidence = 20;
  good.score = 5.0;
  FittedStairway poor = fitted(0, 4);
  poor.model.nosing += Eigen::Vector3d(0.05, 0.1, 0.05);
  poor.evidence = 8;
  poor.score = 9.0;
  FittedStairway elsewhere = fitted(0, 4);
  elsewhere.model.nosing += Eigen::Vector3d(0, 3, 0);
  elsewhere.sides = {2.4, 3.6};
  elsewhere.evidence = 3;
  elsewhere.score = 7.0;
  const std::vector<FittedStairway> kept = without_duplicates({poor, good, elsewhere});
  ASSERT_EQ(kept.size(), 2U);
  EXPECT_EQ(kept[0].evidence, 20) << "the better supported of the two";
  EXPECT_EQ(kept[1].evidence, 3);
}

TEST(Localisation, reads_the_ends_off_the_outer_parts) {
  const StairModel model = test::make_model(0.17, 0.29);
  std::vector<StairPart> parts;
  for (int number = 0; number < 8; ++number) parts.push_back(test::riser_of(model, number, number < 4 ? 1.2 : 0.7));
  Winner winner;
  winner.graph.model = model;
  for (std::size_t i = 0; i < parts.size(); ++i) winner.graph.parts.push_back({static_cast<int>(i), i});
  const FittedStairway stairway = from_parts(winner, parts);
  EXPECT_NEAR(stairway.sides.length(), 1.2, 1e-9);
  EXPECT_EQ(stairway.last, 7);
}

TEST(Stairway, is_met_at_its_lowest_nosing_from_below_and_at_its_highest_from_above) {
  Stairway stairway;
  for (const double x : {0.0, 0.3, 0.6}) stairway.nosings.push_back({.left = {x, 0.5, x}, .right = {x, -0.7, x}});
  EXPECT_EQ(stairway.met_nosing().middle(), Eigen::Vector3d(0.0, 0.5 * (0.5 - 0.7), 0.0));
  stairway.direction = StairwayDirection::Descending;
  const Nosing& top = stairway.met_nosing();
  EXPECT_EQ(top.at(AnchorSide::Left), Eigen::Vector3d(0.6, 0.5, 0.6));
  EXPECT_EQ(top.at(AnchorSide::Right), Eigen::Vector3d(0.6, -0.7, 0.6));
  EXPECT_EQ(top.at(AnchorSide::Middle), top.middle());
}

}  // namespace
}  // namespace stairway::detect
