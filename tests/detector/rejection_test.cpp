// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "detector/stairway_detector.hpp"
#include "tests/detector/scene_fixtures.hpp"

namespace stairway::detect {
namespace {

TEST(Rejection, names_a_flight_of_two_steps) {
  sim::StairSpec platform;
  platform.steps = 2;
  const Detection detection = detect_stairways(test::simulate(platform, 1.5, 0.0, 8.0).cloud);
  EXPECT_TRUE(detection.stairways.empty());
  ASSERT_FALSE(detection.rejected.empty());
  EXPECT_EQ(detection.rejected[0].reason, "too-few-steps");
}

TEST(Rejection, an_empty_cloud_is_answered_with_a_reason) {
  const Detection detection = detect_stairways({});
  EXPECT_TRUE(detection.stairways.empty());
  ASSERT_EQ(detection.rejected.size(), 1U);
  EXPECT_EQ(detection.rejected[0].reason, "empty-cloud");
}

TEST(Rejection, a_bare_floor_is_answered_with_what_is_missing) {
  scan::PointCloud floor;
  for (int i = 0; i < 200; ++i)
    for (int k = 0; k < 200; ++k)
      floor.points.emplace_back(0.02F * static_cast<float>(i), 0.02F * static_cast<float>(k), 0.0F);
  const Detection detection = detect_stairways(floor);
  EXPECT_TRUE(detection.stairways.empty());
  ASSERT_EQ(detection.rejected.size(), 1U);
  EXPECT_EQ(detection.rejected[0].reason, "no-step-pair");
}

}  // namespace
}  // namespace stairway::detect
