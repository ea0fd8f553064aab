// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "detector/stair_model.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "tests/detector/part_fixtures.hpp"

namespace stairway::detect {
namespace {

TEST(StairModel, climbs_against_s) {
  const StairModel model = test::make_model(0.17, 0.29, std::numbers::pi / 2, {1, 2, 0.17});
  const StepFrame third = model.step(3);
  EXPECT_LT((third.nosing - Eigen::Vector3d(1, 2 + 3 * 0.29, 0.17 + 3 * 0.17)).norm(), 1e-12);
  EXPECT_LT((third.left() - Eigen::Vector3d(-1, 0, 0)).norm(), 1e-12) << "left of one who walks along +y is -x";
  EXPECT_LT((model.step(-1).nosing - Eigen::Vector3d(1, 2 - 0.29, 0.0)).norm(), 1e-12);
}

TEST(StepLimits, are_those_of_the_paper) {
  const StepLimits limits;
  EXPECT_TRUE(limits.allow(0.17, 0.29));
  EXPECT_TRUE(limits.allow(0.11, 0.40)) << "15.4 degrees";
  EXPECT_FALSE(limits.allow(0.109, 0.30));
  EXPECT_FALSE(limits.allow(0.241, 0.30));
  EXPECT_FALSE(limits.allow(0.17, 0.179));
  EXPECT_FALSE(limits.allow(0.17, 0.401));
  EXPECT_FALSE(limits.allow(0.24, 0.19)) << "steeper than 50 degrees";
}

}  // namespace
}  // namespace stairway::detect
