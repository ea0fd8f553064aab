// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "detector/stair_graph.hpp"

#include <gtest/gtest.h>

#include "tests/detector/part_fixtures.hpp"

namespace stairway::detect {
namespace {

const StairModel kModel = test::make_model(0.17, 0.29);
const Interval kSide{-0.6, 0.6};

StairGraph extend(const std::vector<StairPart>& parts, int start = 0) {
  StairModel model = kModel;
  model.nosing = kModel.step(start).nosing;
  return extend_graph(model, kSide, parts, View::FromBelow);
}

TEST(StairGraph, grows_to_both_ends_from_anywhere) {
  const std::vector<StairPart> parts = test::flight_of_risers(kModel, 8);
  for (int start = 0; start < 8; ++start) {
    const StairGraph graph = extend(parts, start);
    ASSERT_EQ(graph.parts.size(), 8U) << "from step " << start;
    EXPECT_EQ(graph.parts.front().step, -start);
    EXPECT_EQ(graph.seen_steps(), 8);
  }
}

TEST(StairGraph, crosses_one_hidden_step_but_not_two) {
  std::vector<StairPart> parts = test::flight_of_risers(kModel, 8);
  parts.erase(parts.begin() + 3);
  EXPECT_EQ(extend(parts).seen_steps(), 7);
  parts.erase(parts.begin() + 3);
  EXPECT_EQ(extend(parts).seen_steps(), 3);
}

TEST(StairGraph, takes_treads_and_risers_of_the_same_step) {
  std::vector<StairPart> parts = test::flight_of_risers(kModel, 3);
  for (int number = 0; number < 3; ++number) parts.push_back(test::tread_of(kModel, number));
  const StairGraph graph = extend(parts);
  EXPECT_EQ(graph.parts.size(), 6U);
  EXPECT_EQ(graph.seen_steps(), 3);
}

TEST(StairGraph, leaves_out_what_does_not_comply) {
  std::vector<StairPart> parts = test::flight_of_risers(kModel, 4);
  StairPart shifted = test::riser_of(kModel, 2);
  shifted.centroid.x() += 0.08;
  parts.push_back(shifted);
  StairPart aside = test::riser_of(kModel, 1, 0.4);
  for (Eigen::Vector3d* p : {&aside.centroid, &aside.end_a, &aside.end_b, &aside.front, &aside.back}) p->y() += 0.9;
  parts.push_back(aside);
  EXPECT_EQ(extend(parts).parts.size(), 4U);
}

TEST(StairGraph, is_a_stairway_with_three_steps_and_a_slope_people_walk) {
  EXPECT_EQ(broken_rule(extend(test::flight_of_risers(kModel, 3))), "");
  EXPECT_EQ(broken_rule(extend(test::flight_of_risers(kModel, 2))), "too-few-steps");
  StairGraph flat = extend(test::flight_of_risers(kModel, 3));
  flat.model.height_m = 0.10;  // 19 degrees
  EXPECT_EQ(broken_rule(flat), "slope-out-of-range");
}

TEST(StairScore, is_the_number_of_parts_times_their_fit) {
  const std::vector<StairPart> risers = test::flight_of_risers(kModel, 5);
  const StairScore perfect = score(extend(risers), risers, View::FromBelow);
  EXPECT_NEAR(perfect.risers, 3.0, 1e-6) << "three subscores of at most 1 (eq 3)";
  EXPECT_NEAR(perfect.total(), 15.0, 1e-5) << "eq 2";

  std::vector<StairPart> worse = risers;
  worse[2].centroid.x() += 0.029;  // a tenth of d off
  const StairScore lower = score(extend(worse), worse, View::FromBelow);
  EXPECT_NEAR(perfect.total() - lower.total(), 0.1, 1e-6);
}

TEST(StairScore, counts_two_subscores_for_a_tread) {
  std::vector<StairPart> treads;
  for (int number = 0; number < 4; ++number) treads.push_back(test::tread_of(kModel, number));
  const StairScore perfect = score(extend(treads), treads, View::FromBelow);
  EXPECT_EQ(perfect.tread_count, 4);
  EXPECT_NEAR(perfect.total(), 8.0, 1e-6);
}

}  // namespace
}  // namespace stairway::detect
