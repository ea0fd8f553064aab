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

StairModel quarter_turning(double turn) {
  StairModel model = test::make_model(0.18, 0.25, 0.3, {1, 2, 0.18});
  model.turn_rad = turn;
  return model;
}

TEST(SpiralModel, winds_about_an_axis_with_equal_chords) {
  for (const double turn : {std::numbers::pi / 8, -std::numbers::pi / 8}) {
    SCOPED_TRACE(turn);
    const StairModel model = quarter_turning(turn);
    const Eigen::Vector3d axis = model.step(0).from_step({.v = model.radius_m()});
    EXPECT_GT(model.radius_m() * turn, 0.0) << "ascent turns left about an axis to the left";
    for (int j = -3; j < 9; ++j) {
      const StepFrame step = model.step(j);
      EXPECT_NEAR((step.nosing - axis).head<2>().norm(), std::abs(model.radius_m()), 1e-12);
      EXPECT_NEAR(step.to_step(axis).u, 0.0, 1e-12) << "nosings point at the axis";
      EXPECT_NEAR((model.step(j + 1).nosing - step.nosing).head<2>().norm(), 0.25, 1e-12);
      EXPECT_NEAR(step.nosing.z(), 0.18 * (j + 1), 1e-12);
      const Eigen::Vector3d next = model.step(j + 1).descent;
      EXPECT_NEAR(std::atan2(step.descent.cross(next).z(), step.descent.dot(next)), turn, 1e-12);
      EXPECT_GT(-step.descent.dot(model.step(j + 1).nosing - step.nosing), 0.0) << "and climb against s";
    }
  }
}

TEST(SpiralModel, keeps_its_steps_when_its_middle_line_moves) {
  const StairModel model = quarter_turning(0.4);
  const StairModel moved = model.moved_aside(0.1);
  EXPECT_LT(moved.depth_m, model.depth_m) << "nearer to the axis";
  for (int j : {-2, 0, 5}) {
    EXPECT_LT((moved.step(j).nosing - model.step(j).from_step({.v = 0.1})).norm(), 1e-12);
    EXPECT_LT((moved.step(j).descent - model.step(j).descent).norm(), 1e-12);
  }
}

TEST(StepFrame, gives_back_the_point_it_was_asked_for) {
  const StepFrame step = quarter_turning(0.4).step(2.5);
  const Eigen::Vector3d p(0.3, -1.2, 0.9);
  EXPECT_LT((step.from_step(step.to_step(p)) - p).norm(), 1e-12);
}

TEST(StepLimits, are_those_of_the_paper) {
  const StepLimits limits;
  const auto allow = [&](double height, double depth) { return limits.allow(test::make_model(height, depth)); };
  EXPECT_TRUE(allow(0.17, 0.29));
  EXPECT_TRUE(allow(0.11, 0.40)) << "15.4 degrees";
  EXPECT_FALSE(allow(0.109, 0.30));
  EXPECT_FALSE(allow(0.241, 0.30));
  EXPECT_FALSE(allow(0.17, 0.179));
  EXPECT_FALSE(allow(0.17, 0.401));
  EXPECT_FALSE(allow(0.24, 0.19)) << "steeper than 50 degrees";
}

}  // namespace
}  // namespace stairway::detect
