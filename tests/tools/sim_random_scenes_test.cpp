// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>

#include "tools/sim/outline.hpp"
#include "tools/sim/random_scenes.hpp"

namespace stairway::sim {
namespace {

constexpr std::uint64_t kSeeds = 200;

TEST(SimRandomScenes, can_all_be_built) {
  for (std::uint64_t seed = 0; seed < kSeeds; ++seed) {
    SCOPED_TRACE(seed);
    EXPECT_EQ(random_stair_scene(seed).problem(), "");
    EXPECT_EQ(random_room(seed).problem(), "");
  }
}

TEST(SimRandomScenes, stairs_can_be_walked_and_are_seen_askew_by_forty_degrees_at_most) {
  for (std::uint64_t seed = 0; seed < kSeeds; ++seed) {
    SCOPED_TRACE(seed);
    const SceneSpec spec = random_stair_scene(seed);
    ASSERT_EQ(spec.stairs.size(), 1U);
    const StairSpec& stairs = spec.stairs[0];
    EXPECT_NEAR(2 * stairs.height_m + stairs.depth_m, 0.64, 0.06);
    EXPECT_GE(stairs.position.norm(), 0.6);
    EXPECT_LE(stairs.position.norm(), 4.0);
    const double bearing = std::atan2(stairs.position.y(), stairs.position.x());
    EXPECT_LE(std::abs(std::remainder(stairs.heading_rad - bearing, 2 * M_PI)), 40.01 * M_PI / 180);
  }
}

TEST(SimRandomScenes, nothing_stands_on_the_stairs_or_before_them) {
  for (std::uint64_t seed = 0; seed < kSeeds; ++seed) {
    SCOPED_TRACE(seed);
    const SceneSpec spec = random_stair_scene(seed);
    std::vector<Eigen::Vector2d> view = build_flight(spec.stairs[0]).footprint;
    view.emplace_back(0.0, 0.0);
    for (const auto& piece : spec.furniture) EXPECT_FALSE(overlap(piece.footprint(), convex_hull(view)));
  }
}

TEST(SimRandomScenes, differ_by_seed_and_repeat_themselves) {
  EXPECT_EQ(random_stair_scene(4).stairs[0].height_m, random_stair_scene(4).stairs[0].height_m);
  EXPECT_NE(random_stair_scene(4).stairs[0].height_m, random_stair_scene(5).stairs[0].height_m);
  EXPECT_NE(random_room(4).room.low.x(), random_room(5).room.low.x());
}

TEST(SimRandomScenes, are_the_same_on_every_machine) {
  EXPECT_NEAR(random_stair_scene(1).stairs[0].height_m, 0.17809671228150001, 1e-12);
}

}  // namespace
}  // namespace stairway::sim
