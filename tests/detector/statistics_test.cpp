// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "detector/statistics.hpp"

#include <gtest/gtest.h>

namespace stairway::detect {
namespace {

TEST(Statistics, the_median_is_the_value_in_the_middle_or_the_upper_of_two) {
  EXPECT_EQ(median({7.0}), 7.0);
  EXPECT_EQ(median({9.0, 1.0, 5.0}), 5.0);
  EXPECT_EQ(median({4.0, 1.0, 3.0, 2.0}), 3.0);
}

TEST(Statistics, the_deviation_ignores_wild_values) {
  EXPECT_NEAR(robust_deviation({-1.0, 1.0, -1.0, 1.0, 1e9}, 0.0), 1.4826, 1e-12);
  EXPECT_EQ(robust_deviation({3.0, 3.0, 3.0, 99.0}, 3.0), 0.0);
}

TEST(Statistics, the_outer_quartile_is_a_quarter_of_the_way_in) {
  const std::vector<double> values{5.0, 1.0, 3.0, 2.0, 4.0};
  EXPECT_EQ(outer_quartile(values, false), 2.0);
  EXPECT_EQ(outer_quartile(values, true), 4.0);
  EXPECT_EQ(outer_quartile({6.0, 8.0}, true), 8.0);
}

}  // namespace
}  // namespace stairway::detect
