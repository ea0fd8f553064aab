// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>

#include "tools/common/stairway_match.hpp"
#include "tools/sim/stair_spec.hpp"
#include "tools/stairway/stair_chart.hpp"
#include "tools/stairway/truth_table.hpp"

namespace stairway::tools {
namespace {

detect::Stairway flight(double turn_per_step_rad, int steps, bool descending = false) {
  sim::StairSpec spec;
  spec.steps = steps;
  spec.turn_per_step_rad = turn_per_step_rad;
  spec.heading_rad = 0.7;
  spec.descending = descending;
  return sim::build_flight(spec).truth;
}

TEST(StairChart, lays_the_steps_of_any_stairway_out_in_a_row) {
  for (const double turn : {0.0, 0.3, -0.3}) {
    for (const int steps : {3, 14, 28}) {
      for (const bool descending : {false, true}) {
        SCOPED_TRACE(::testing::Message() << turn << " rad, " << steps << " steps, descending " << descending);
        const detect::Stairway stairway = flight(turn, steps, descending);
        const StairChart chart(stairway);
        // On a spiral the way along the arc is a little longer than the chord that is called the depth.
        const double depth = turn == 0.0 ? 0.29 : 0.29 * (0.5 * std::abs(turn)) / std::sin(0.5 * std::abs(turn));
        for (std::size_t i = 0; i < stairway.nosings.size(); ++i) {
          const Eigen::Vector3d middle = chart.nosings()[i];
          EXPECT_NEAR(middle.x(), depth * static_cast<double>(i), 1e-6);
          EXPECT_NEAR(middle.y(), 0.0, 1e-6);
          EXPECT_NEAR(middle.z() - chart.foot_m(), 0.17 * static_cast<double>(i + 1), 1e-6);
          EXPECT_NEAR(chart.to_chart(stairway.nosings[i].left).y(), 0.6, 1e-6);
          EXPECT_NEAR(chart.to_chart(stairway.nosings[i].right).y(), -0.6, 1e-6);
        }
      }
    }
  }
}

TEST(StairChart, tells_treads_risers_and_the_rest_apart) {
  const StairChart chart(flight(0.0, 5));
  using Part = StairChart::Part;
  EXPECT_EQ(chart.part_at({0.15, 0.3, 0.17}, 0.03), Part::Tread);
  EXPECT_EQ(chart.part_at({0.29, -0.3, 0.25}, 0.03), Part::Riser);
  EXPECT_EQ(chart.part_at({0.0, 0.0, 0.08}, 0.03), Part::Riser);
  EXPECT_EQ(chart.part_at({0.15, 0.8, 0.17}, 0.03), Part::None) << "beside the flight";
  EXPECT_EQ(chart.part_at({0.15, 0.0, 0.60}, 0.03), Part::None) << "above it";
  EXPECT_EQ(chart.part_at({0.15, 0.0, 0.05}, 0.03), Part::None) << "below it";
}

TEST(TruthTable, pairs_every_stairway_once_with_the_nearest_one) {
  const detect::Stairway here = flight(0.0, 10);
  detect::Stairway beside = here, far = here;
  for (detect::Nosing& nosing : beside.nosings) nosing.left.x() += 0.1, nosing.right.x() += 0.1;
  for (detect::Nosing& nosing : far.nosings) nosing.left.x() += 5.0, nosing.right.x() += 5.0;
  using Pairs = std::vector<std::pair<std::size_t, std::size_t>>;
  EXPECT_EQ(match({here, far}, {beside, here}), (Pairs{{0, 1}}));
  EXPECT_EQ(match({far, here}, {beside, far}), (Pairs{{0, 1}, {1, 0}}));
  EXPECT_EQ(match({here}, {detect::Stairway{}}), Pairs{}) << "nothing is known about where that one is";
  EXPECT_EQ(match({}, {here}), Pairs{});
}

TEST(TruthTable, differences_are_found_minus_true_and_headings_wrap) {
  detect::Stairway truth = flight(0.0, 10), found = truth;
  truth.heading = M_PI - 0.001;
  found.heading = -M_PI + 0.001;
  found.step_height += 0.0012;
  const std::string text = truth_text({truth}, {found});
  EXPECT_NE(text.find("+1.2"), std::string::npos) << text;
  EXPECT_NE(text.find("+0.11"), std::string::npos) << text;
}

}  // namespace
}  // namespace stairway::tools
