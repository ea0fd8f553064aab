// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <set>

#include "tools/evaluation/error_quantity.hpp"
#include "tools/evaluation/measurement_series.hpp"
#include "tools/evaluation/stairway_error.hpp"
#include "tools/sim/stair_spec.hpp"

namespace stairway::evaluation {
namespace {

detect::Stairway flight(double heading_rad, bool descending = false) {
  sim::StairSpec spec;
  spec.steps = 5;
  spec.heading_rad = heading_rad;
  spec.descending = descending;
  return sim::build_flight(spec).truth;
}

TEST(Spread, of_known_values) {
  const std::array<double, 4> values{1.0, 2.0, 3.0, 6.0};
  const Spread spread = spread_of(values);
  EXPECT_EQ(spread.count, 4U);
  EXPECT_DOUBLE_EQ(spread.mean, 3.0);
  EXPECT_DOUBLE_EQ(spread.deviation, std::sqrt(14.0 / 3.0));
  EXPECT_DOUBLE_EQ(spread.largest, 6.0);
  EXPECT_TRUE(std::isnan(spread_of(std::span(values).first(1)).deviation));
  EXPECT_TRUE(std::isnan(spread_of({}).mean));
}

TEST(StairwayError, of_the_truth_itself_is_zero) {
  for (const bool descending : {false, true}) {
    const detect::Stairway truth = flight(2.0, descending);
    const StairwayError error = error_of(truth, truth);
    EXPECT_NEAR(error.anchor_m(), 0.0, 1e-12);
    EXPECT_NEAR(error.middle_m, 0.0, 1e-12);
    EXPECT_EQ(error.height_m, 0.0);
    EXPECT_EQ(error.steps, 0);
    EXPECT_TRUE(error.is_right_kind && error.is_right_direction);
  }
}

TEST(StairwayError, of_the_anchor_is_split_along_and_across_the_ascent) {
  for (const double heading : {0.0, 1.0, 3.0}) {
    const detect::Stairway truth = flight(heading);
    const Eigen::Vector3d ascent(std::cos(heading), std::sin(heading), 0.0), left(-ascent.y(), ascent.x(), 0.0);
    detect::Stairway found = truth;
    found.anchor += 0.03 * ascent - 0.02 * left + Eigen::Vector3d(0.0, 0.0, 0.01);
    const StairwayError error = error_of(found, truth);
    EXPECT_NEAR(error.along_m, 0.03, 1e-12);
    EXPECT_NEAR(error.across_m, -0.02, 1e-12);
    EXPECT_NEAR(error.up_m, 0.01, 1e-12);
  }
}

TEST(StairwayError, compares_the_anchor_with_the_end_that_its_side_names) {
  const detect::Stairway truth = flight(0.5);
  detect::Stairway found = truth;
  found.anchor_side = detect::AnchorSide::Left;
  found.anchor = truth.nosings.front().left;
  found.nosings.front().right += Eigen::Vector3d(0.2, 0.0, 0.0);
  const StairwayError error = error_of(found, truth);
  EXPECT_NEAR(error.anchor_m(), 0.0, 1e-12);
  EXPECT_NEAR(error.middle_m, 0.1, 1e-12);
}

TEST(StairwayError, headings_wrap) {
  detect::Stairway truth = flight(0.0), found = truth;
  truth.heading = M_PI - 0.01;
  found.heading = -M_PI + 0.01;
  EXPECT_NEAR(error_of(found, truth).heading_rad, 0.02, 1e-12);
}

TEST(Outcome, tells_found_missed_and_false_apart) {
  const detect::Stairway here = flight(0.0);
  detect::Stairway far = here;
  for (detect::Nosing& nosing : far.nosings) nosing.left.x() += 5.0, nosing.right.x() += 5.0;
  const std::vector<Outcome> outcomes{outcome_of({.stairways = {here, far}}, {here}),
                                      outcome_of({.stairways = {far}}, {here}), outcome_of({}, {here}),
                                      outcome_of({.stairways = {far}}, {here, far}, 1)};
  EXPECT_EQ(found_count(outcomes), 2);
  EXPECT_EQ(false_count(outcomes), 2);
  EXPECT_EQ(right_step_count(outcomes), 2);
  EXPECT_FALSE(outcomes[1].error);
}

TEST(Outcome, errors_are_averaged_over_what_was_found) {
  std::vector<Outcome> outcomes(3);
  outcomes[0].error = StairwayError{.height_m = -0.002};
  outcomes[2].error = StairwayError{.height_m = 0.004};
  const Spread spread = absolute_error(outcomes, kHeightError);
  EXPECT_EQ(spread.count, 2U);
  EXPECT_DOUBLE_EQ(spread.mean, 3.0);
}

TEST(SeriesRuns, are_the_papers_when_nothing_is_left_out) {
  const auto runs = series_runs(1.0);
  EXPECT_EQ(runs.size(), 2U * 13U * 10U);
  EXPECT_DOUBLE_EQ(runs.front().distance_m, 0.5);
  EXPECT_DOUBLE_EQ(runs.back().distance_m, 6.5);
  std::set<std::uint64_t> streams;
  for (const SeriesRun& run : runs) streams.insert(run.stream);
  EXPECT_EQ(streams.size(), runs.size()) << "two sweeps have the same noise";
}

TEST(SeriesRuns, a_share_is_a_part_of_the_same_sweeps) {
  const auto all = series_runs(1.0);
  for (const double share : {0.5, 0.1, 0.05, 1e-6}) {
    for (const std::size_t stride : {1U, 2U}) {
      SCOPED_TRACE(::testing::Message() << share << ", every place of " << stride);
      const auto some = series_runs(share, stride);
      EXPECT_GE(some.size(), 2U);
      EXPECT_LE(static_cast<double>(some.size()), std::max(2.0, 1.3 * share * 260.0));
      for (const SeriesRun& run : some) {
        const auto same = std::find_if(all.begin(), all.end(), [&](const auto& r) { return r.stream == run.stream; });
        ASSERT_NE(same, all.end());
        EXPECT_EQ(same->stairway, run.stairway);
        EXPECT_EQ(same->distance_m, run.distance_m);
      }
    }
  }
}

}  // namespace
}  // namespace stairway::evaluation
