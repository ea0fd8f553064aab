// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "detector/step_offsets.hpp"

#include <gtest/gtest.h>

namespace stairway::detect {
namespace {

StairModel flight() {
  StairModel model;
  model.height_m = 0.17;
  model.depth_m = 0.29;
  model.descent = -Eigen::Vector3d::UnitX();
  model.nosing = {2.0, 0.0, 0.17};
  return model;
}

/// What is measured on a step that lies `up_m` above and `ahead_m` beyond its regular place.
StepMeasurement measured(int number, double up_m, double ahead_m) {
  StepMeasurement step{.number = number, .frame = flight().step(number)};
  step.front = Estimate{ahead_m, 0.0002};
  step.nosing = NosingSight{.at = {0.0, 0.0, up_m}, .sigma_m = 0.0005, .distance_m = 2.5};
  return step;
}

std::vector<StepMeasurement> steps(const std::vector<double>& up_m, double ahead_m = 0.0) {
  std::vector<StepMeasurement> all;
  for (const double up : up_m) all.push_back(measured(static_cast<int>(all.size()), up, ahead_m));
  return all;
}

TEST(StepOffsets, tell_how_far_each_nosing_is_off) {
  const auto offsets = step_offsets(flight(), {}, steps({0.0, 0.012, -0.005}, 0.003));
  ASSERT_EQ(offsets.size(), 3U);
  ASSERT_TRUE(offsets[1].up && offsets[1].ahead);
  EXPECT_NEAR(offsets[1].up->value, 0.012, 1e-9);
  EXPECT_NEAR(offsets[2].up->value, -0.005, 1e-9);
  EXPECT_NEAR(offsets[1].ahead->value, 0.003, 1e-9);
  EXPECT_GT(offsets[1].up->sigma, 0.0);
}

TEST(StepOffsets, leave_out_what_all_sights_are_off_by) {
  const auto offsets = step_offsets(flight(), {.sight_rad = 2e-3}, steps({0.005}));
  ASSERT_TRUE(offsets.front().up);
  EXPECT_NEAR(offsets.front().up->value, 0.0, 1e-9);
}

TEST(StepOffsets, prefer_the_tread_to_the_sight_over_its_nosing) {
  StepMeasurement step = measured(0, 0.02, 0.0);
  step.surface = Estimate{0.001, 0.0002};
  EXPECT_NEAR(step_offsets(flight(), {}, {step}).front().up->value, 0.001, 1e-9);
}

TEST(Irregularity, is_told_when_steps_differ_by_more_than_errors_explain) {
  EXPECT_TRUE(are_irregular(step_offsets(flight(), {}, steps({0.0, 0.012, -0.011, 0.004, -0.013}))));
  EXPECT_FALSE(are_irregular(step_offsets(flight(), {}, steps({0.0, 0.001, -0.001, 0.0005, -0.001}))));
}

TEST(Irregularity, is_not_told_from_uncertain_few_or_mistaken_steps) {
  std::vector<StepMeasurement> uncertain = steps({0.0, 0.012, -0.011, 0.004, -0.013});
  for (StepMeasurement& step : uncertain) step.nosing->sigma_m = 0.008;
  EXPECT_FALSE(are_irregular(step_offsets(flight(), {}, uncertain)));
  EXPECT_FALSE(are_irregular(step_offsets(flight(), {}, steps({0.012, -0.012}))));
  EXPECT_FALSE(are_irregular(step_offsets(flight(), {}, steps({0.0, 0.0, 0.09, 0.0, 0.0}))));
}

}  // namespace
}  // namespace stairway::detect
