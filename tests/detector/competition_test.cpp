// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "detector/competition.hpp"

#include <gtest/gtest.h>

#include <set>

#include "tests/detector/part_fixtures.hpp"

namespace stairway::detect {
namespace {

CompetitionResult run(const std::vector<StairPart>& parts, Strategy strategy) {
  CompetitionOptions options;
  options.strategy = strategy;
  return compete(parts, options);
}

std::vector<StairPart> two_flights() {
  std::vector<StairPart> parts = test::flight_of_risers(test::make_model(0.17, 0.29), 7);
  for (const StairPart& part : test::flight_of_risers(test::make_model(0.18, 0.27, 2.0, {-3, 1, 0.18}), 5))
    parts.push_back(part);
  return test::with_regions(parts);
}

TEST(Competition, finds_every_flight_once_with_every_strategy) {
  for (const Strategy strategy : {Strategy::Greedy, Strategy::Thorough, Strategy::Optimizing}) {
    SCOPED_TRACE(static_cast<int>(strategy));
    const CompetitionResult result = run(two_flights(), strategy);
    ASSERT_EQ(result.winners.size(), 2U);
    EXPECT_FALSE(result.runner_up);
    std::set<std::size_t> taken;
    for (const Winner& winner : result.winners)
      for (const GraphPart& entry : winner.graph.parts) EXPECT_TRUE(taken.insert(entry.part).second);
    EXPECT_EQ(taken.size(), 12U);
    EXPECT_GE(result.winners[0].score, result.winners[1].score);
  }
}

TEST(Competition, greedy_goes_on_without_the_planes_that_a_stairway_has_taken) {
  std::vector<StairPart> parts = two_flights();
  parts.back().region = parts.front().region;
  const CompetitionResult result = run(parts, Strategy::Greedy);
  ASSERT_EQ(result.winners.size(), 2U);
  EXPECT_EQ(result.winners[0].graph.parts.size(), 7U);
  EXPECT_EQ(result.winners[1].graph.parts.size(), 4U);
}

TEST(Competition, thorough_prefers_the_initialisation_that_fits_best) {
  // The first pair misleads: its upper riser is cut at the bottom, so h from the bottoms is wrong.
  const StairModel model = test::make_model(0.17, 0.29);
  std::vector<StairPart> parts;
  for (int number = 0; number < 6; ++number) parts.push_back(test::riser_of(model, number, 1.2, 0.01 * number));
  const CompetitionResult result = run(test::with_regions(parts), Strategy::Thorough);
  ASSERT_EQ(result.winners.size(), 1U);
  EXPECT_NEAR(result.winners[0].graph.model.height_m, 0.17, 1e-9);
}

TEST(Competition, optimizing_is_nearer_to_the_truth_than_any_single_pair) {
  const StairModel model = test::make_model(0.17, 0.29);
  std::vector<StairPart> parts = test::flight_of_risers(model, 8);
  for (std::size_t i = 0; i < parts.size(); ++i) {
    parts[i].top.z() += i % 2 == 0 ? 0.004 : -0.004;
    parts[i].bottom.z() += i % 2 == 0 ? 0.004 : -0.004;
    parts[i].centroid.x() += i % 3 == 0 ? 0.005 : -0.002;
  }
  const auto error = [&](Strategy strategy) {
    const StairModel found = run(parts, strategy).winners.at(0).graph.model;
    return std::abs(found.height_m - 0.17) + std::abs(found.depth_m - 0.29);
  };
  EXPECT_LT(error(Strategy::Optimizing), 0.3 * error(Strategy::Thorough));
  EXPECT_LT(error(Strategy::Optimizing), 0.002);
}

TEST(Competition, names_the_best_that_failed) {
  const CompetitionResult result = run(test::flight_of_risers(test::make_model(0.17, 0.29), 2), Strategy::Thorough);
  EXPECT_TRUE(result.winners.empty());
  ASSERT_TRUE(result.runner_up);
  EXPECT_EQ(result.runner_up->reason, "too-few-steps");
  EXPECT_FALSE(run({}, Strategy::Thorough).runner_up) << "without parts there is no candidate to name";
}

}  // namespace
}  // namespace stairway::detect
