// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "detector/step_ends.hpp"

#include <gtest/gtest.h>

namespace stairway::detect {
namespace {

TEST(CommonEnd, is_the_mean_of_ends_that_agree) {
  const auto end = common_end({{0.600, 0.003}, {0.604, 0.003}, {0.596, 0.003}}, +1.0);
  ASSERT_TRUE(end);
  EXPECT_NEAR(end->value, 0.600, 1e-6);
  EXPECT_LT(end->sigma, 0.004);
}

TEST(CommonEnd, is_the_outer_one_where_posts_cut_steps_short) {
  const std::vector<Estimate> left{{0.55, 0.003}, {0.60, 0.003}, {0.54, 0.003}, {0.601, 0.003}, {0.56, 0.003}};
  EXPECT_NEAR(common_end(left, +1.0)->value, 0.6005, 0.001);
  std::vector<Estimate> right = left;
  for (Estimate& end : right) end.value *= -1.0;
  EXPECT_NEAR(common_end(right, -1.0)->value, -0.6005, 0.001);
}

TEST(CommonEnd, is_not_what_a_few_uncertain_ends_say) {
  const auto end = common_end({{0.60, 0.002}, {0.601, 0.002}, {0.599, 0.002}, {0.73, 0.02}}, +1.0);
  EXPECT_NEAR(end->value, 0.60, 0.002);
}

TEST(CommonEnd, of_one_step_is_uncertain_and_of_none_unknown) {
  EXPECT_GT(common_end({{0.6, 0.001}}, +1.0)->sigma, 0.01);
  EXPECT_FALSE(common_end({}, +1.0));
}

}  // namespace
}  // namespace stairway::detect
