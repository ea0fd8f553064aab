// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <string>

#include "tools/sim/angles.hpp"
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
    EXPECT_EQ(random_spiral_scene(seed).problem(), "");
    EXPECT_EQ(random_descending_scene(seed).problem(), "");
    EXPECT_EQ(random_mid_landing_scene(seed).problem(), "");
    EXPECT_EQ(random_inverted_descending_scene(seed).problem(), "");
  }
}

TEST(SimRandomScenes, keep_the_upper_edge_away_from_the_robot_however_askew_it_is) {
  for (const std::uint64_t seed : {50021, 50283}) {
    SCOPED_TRACE(seed);
    EXPECT_EQ(random_inverted_descending_scene(seed).problem(), "");
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
    EXPECT_LE(std::abs(std::remainder(stairs.heading_rad - bearing, 2 * M_PI)), 40.01 * kDegree);
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

double skew(const StairSpec& stairs, double way_rad) {
  return std::abs(std::remainder(way_rad - std::atan2(stairs.position.y(), stairs.position.x()), 2 * M_PI));
}

TEST(SimRandomScenes, spirals_turn_once_at_most_and_leave_headroom) {
  int left = 0;
  int open = 0;
  for (std::uint64_t seed = 0; seed < kSeeds; ++seed) {
    SCOPED_TRACE(seed);
    const StairSpec stairs = random_spiral_scene(seed).stairs.at(0);
    const double turn = std::abs(stairs.turn_per_step_rad);
    left += stairs.turn_per_step_rad > 0;
    open += stairs.open_risers;
    EXPECT_GE(turn, 12 * kDegree);
    EXPECT_LE(turn, 36 * kDegree);
    EXPECT_LE(stairs.steps * turn, 2 * M_PI);
    EXPECT_GE(stairs.depth_m / (2 * std::sin(turn / 2)), stairs.width_m / 2) << "treads reach beyond the axis";
    EXPECT_TRUE(stairs.steps * turn < 1.5 * M_PI || stairs.steps * stairs.height_m > 2.1);
    EXPECT_GE(stairs.position.norm(), 0.8);
    EXPECT_LE(stairs.position.norm(), 3.0);
    EXPECT_LE(skew(stairs, stairs.heading_rad), 40.01 * kDegree);
  }
  EXPECT_NEAR(left, 100, 30);
  EXPECT_NEAR(open, 80, 30);
}

// How many nosings the scanner sees over the edge, its own height above the floor.
int nosings_within_view(const StairSpec& stairs, const scan::MountOptions& mount) {
  const double lowest = mount.scan_plane_pitch_rad > 0 ? -std::asin(std::sin(mount.scan_plane_pitch_rad) * M_SQRT1_2)
                                                       : mount.scan_plane_pitch_rad;
  int seen = 0;
  for (int j = 0; j < stairs.steps; ++j) {
    const double distance = stairs.position.norm() + j * stairs.depth_m;
    seen += std::atan2(-(mount.disk_z_m + j * stairs.height_m), distance) >= lowest;
  }
  return seen;
}

TEST(SimRandomScenes, robots_at_the_upper_edge_have_a_scanner_that_sees_steps) {
  int upright = 0;
  for (std::uint64_t seed = 0; seed < kSeeds; ++seed) {
    SCOPED_TRACE(seed);
    const SceneSpec spec = random_descending_scene(seed);
    const StairSpec& stairs = spec.stairs.at(0);
    ASSERT_TRUE(stairs.descending);
    ASSERT_TRUE(spec.mount);
    upright += spec.mount->scan_plane_pitch_rad > 0;
    EXPECT_GE(stairs.position.norm(), 0.25);
    EXPECT_LE(stairs.position.norm(), 0.70);
    EXPECT_LE(skew(stairs, stairs.heading_rad + M_PI), 25.01 * kDegree);
    EXPECT_GE(nosings_within_view(stairs, *spec.mount), 5);
    EXPECT_LE(stairs.depth_m, 0.40);
    EXPECT_GE(stairs.height_m, 0.11);
    EXPECT_GE(std::atan2(stairs.height_m, stairs.depth_m), 20 * kDegree);
  }
  EXPECT_NEAR(upright, 100, 30);
}

TEST(SimRandomScenes, a_landing_between_storeys_has_a_flight_up_and_one_down) {
  for (std::uint64_t seed = 0; seed < kSeeds; ++seed) {
    SCOPED_TRACE(seed);
    const SceneSpec spec = random_mid_landing_scene(seed);
    ASSERT_EQ(spec.stairs.size(), 2U);
    EXPECT_FALSE(spec.stairs[0].descending);
    EXPECT_TRUE(spec.stairs[1].descending);
    EXPECT_FALSE(overlap(build_flight(spec.stairs[0]).footprint, build_flight(spec.stairs[1]).footprint));
    EXPECT_LE(spec.stairs[1].position.norm(), 0.70);
  }
}

TEST(SimRandomScenes, robots_before_stairs_see_past_the_clutter) {
  for (std::uint64_t seed = 0; seed < kSeeds; ++seed) {
    for (const SceneSpec& spec : {random_spiral_scene(seed), random_descending_scene(seed)}) {
      SCOPED_TRACE(spec.name);
      std::vector<Eigen::Vector2d> view = build_flight(spec.stairs[0]).footprint;
      view.emplace_back(0.0, 0.0);
      for (const auto& piece : spec.furniture) EXPECT_FALSE(overlap(piece.footprint(), convex_hull(view)));
    }
  }
}

TEST(SimRandomScenes, rooms_hold_every_kind_of_furniture) {
  std::set<FurnitureKind> kinds;
  for (std::uint64_t seed = 0; seed < kSeeds; ++seed) {
    for (const auto& piece : random_room(seed).furniture) kinds.insert(piece.kind);
  }
  EXPECT_EQ(kinds.size(), kFurnitureKinds);
}

TEST(SimRandomScenes, are_found_by_name_and_seed) {
  for (const std::string_view kind : random_scene_kinds()) {
    const std::string name = std::string{kind} + ":17";
    SCOPED_TRACE(name);
    const auto spec = random_scene(name);
    ASSERT_TRUE(spec);
    EXPECT_EQ(spec->name, name);
    EXPECT_FALSE(random_scene(kind));
    EXPECT_FALSE(random_scene(name + "x"));
  }
}

TEST(SimRandomScenes, differ_by_seed_and_repeat_themselves) {
  EXPECT_EQ(random_stair_scene(4).stairs[0].height_m, random_stair_scene(4).stairs[0].height_m);
  EXPECT_NE(random_stair_scene(4).stairs[0].height_m, random_stair_scene(5).stairs[0].height_m);
  EXPECT_NE(random_room(4).room.low.x(), random_room(5).room.low.x());
  for (const auto make : {random_spiral_scene, random_descending_scene, random_mid_landing_scene}) {
    EXPECT_EQ(make(4).stairs[0].height_m, make(4).stairs[0].height_m);
    EXPECT_EQ(make(4).furniture.size(), make(4).furniture.size());
    EXPECT_NE(make(4).stairs[0].height_m, make(5).stairs[0].height_m);
  }
}

TEST(SimRandomScenes, are_the_same_on_every_machine) {
  EXPECT_NEAR(random_stair_scene(1).stairs[0].height_m, 0.17809671228150001, 1e-12);
}

}  // namespace
}  // namespace stairway::sim
