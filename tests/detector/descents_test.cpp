// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "detector/stairway_detector.hpp"
#include "tools/sim/random_scenes.hpp"
#include "tools/sim/scene.hpp"
#include "tools/sim/sweep.hpp"

namespace stairway::detect {
namespace {

// From 0.65 m before the edge no tread shows more than 9 cm, all but the first less than 5.
TEST(Descents, are_found_from_where_they_only_begin_to_show) {
  const sim::Scene scene = sim::build_scene(sim::random_inverted_descending_scene(1023));
  const scan::PointCloud cloud = sim::simulate_sweep(scene, *scene.mount, {}, {.disk_period_s = 20.0}, 1);
  const Detection detection = detect_stairways(cloud);
  ASSERT_EQ(detection.stairways.size(), 1U);
  EXPECT_EQ(detection.stairways[0].direction, StairwayDirection::Descending);
  EXPECT_NEAR(detection.stairways[0].step_height, scene.truths.front().step_height, 0.003);
  EXPECT_NEAR(detection.stairways[0].step_depth, scene.truths.front().step_depth, 0.005);
}

}  // namespace
}  // namespace stairway::detect
