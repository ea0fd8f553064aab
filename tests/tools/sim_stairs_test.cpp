// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>
#include <string>

#include "tools/sim/bvh.hpp"
#include "tools/sim/scene.hpp"
#include "tools/sim/stair_spec.hpp"

namespace stairway::sim {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kAboveAll_m = 20.0;

// Height of the first surface below a point.
double height_below(const Bvh& bvh, const Vector2d& p) {
  const Hit hit = bvh.cast({static_cast<float>(p.x()), static_cast<float>(p.y()), kAboveAll_m}, {0, 0, -1}, 100.0F);
  return hit.surface == kNoSurface ? -kAboveAll_m : kAboveAll_m - hit.range_m;
}

// Horizontal direction of ascent at a nosing, from its ends alone.
Vector2d ahead(const detect::Nosing& nosing) {
  const Vector2d across = (nosing.left - nosing.right).head<2>().normalized();
  return {across.y(), -across.x()};
}

struct Case {
  std::string name;
  StairSpec spec;
};

std::vector<Case> cases() {
  StairSpec plain;
  plain.position = {1.7, -0.4};
  plain.heading_rad = 0.3;
  const auto with = [&](const char* name, auto change) {
    Case result{name, plain};
    change(result.spec);
    return result;
  };
  return {
      {"closed", plain},
      with("overhang", [](StairSpec& s) { s.overhang_m = 0.03; }),
      with("open", [](StairSpec& s) { s.open_risers = true; }),
      with("open with overhang", [](StairSpec& s) { s.open_risers = true, s.overhang_m = 0.02; }),
      with("descending", [](StairSpec& s) { s.descending = true, s.heading_rad = 3.0; }),
      with("descending, open", [](StairSpec& s) { s.descending = true, s.open_risers = true, s.heading_rad = 3.0; }),
      with("spiral to the left", [](StairSpec& s) { s.turn_per_step_rad = 0.3, s.width_m = 0.8, s.steps = 8; }),
      with("spiral to the right, open",
           [](StairSpec& s) { s.turn_per_step_rad = -0.3, s.width_m = 0.8, s.open_risers = true, s.steps = 8; }),
      with("descending spiral",
           [](StairSpec& s) { s.turn_per_step_rad = 0.25, s.width_m = 0.8, s.descending = true, s.steps = 8; }),
      with("irregular",
           [](StairSpec& s) {
             s.steps = 4;
             s.height_offsets_m = {0.01, -0.01, 0.02, 0.0};
             s.depth_offsets_m = {0.0, 0.03, -0.02, 0.0};
           }),
      with("above a landing", [](StairSpec& s) { s.level_m = 1.02; }),
      with("one step", [](StairSpec& s) { s.steps = 1; }),
  };
}

TEST(SimStairs, treads_begin_exactly_at_the_nosings_of_the_truth) {
  constexpr double kStep_m = 0.004;
  for (const auto& [name, spec] : cases()) {
    SCOPED_TRACE(name);
    const Flight flight = build_flight(spec);
    const Bvh bvh{flight.mesh};
    ASSERT_EQ(flight.truth.nosings.size(), static_cast<std::size_t>(spec.steps));
    for (std::size_t i = 0; i < flight.truth.nosings.size(); ++i) {
      SCOPED_TRACE(i);
      const auto& nosing = flight.truth.nosings[i];
      // Not at 0.5 nor within 0.1 of an end: stringers and balusters are elsewhere.
      for (const double share : {0.15, 0.35, 0.6, 0.85}) {
        const Vector2d edge = (nosing.left + share * (nosing.right - nosing.left)).head<2>();
        EXPECT_NEAR(height_below(bvh, edge + kStep_m * ahead(nosing)), nosing.left.z(), 1e-4);
        EXPECT_LT(height_below(bvh, edge - kStep_m * ahead(nosing)), nosing.left.z() - 0.1);
      }
    }
  }
}

TEST(SimStairs, truth_is_consistent_in_itself) {
  for (const auto& [name, spec] : cases()) {
    SCOPED_TRACE(name);
    const auto truth = build_flight(spec).truth;
    for (const auto& nosing : truth.nosings) {
      EXPECT_NEAR((nosing.left - nosing.right).norm(), spec.width_m, 1e-9);
      EXPECT_EQ(nosing.left.z(), nosing.right.z());
    }
    const Vector2d first = ahead(truth.nosings.front());
    EXPECT_NEAR(std::cos(truth.heading), first.x(), 1e-9);
    EXPECT_NEAR(std::sin(truth.heading), first.y(), 1e-9);
    EXPECT_EQ(truth.kind == detect::StairwayKind::Spiral, spec.turn_per_step_rad != 0);
    if (!spec.height_offsets_m.empty()) continue;
    for (std::size_t i = 1; i < truth.nosings.size(); ++i) {
      const Vector3d step =
          (truth.nosings[i].left + truth.nosings[i].right - truth.nosings[i - 1].left - truth.nosings[i - 1].right) / 2;
      EXPECT_NEAR(step.z(), truth.step_height, 1e-9);
      EXPECT_NEAR(step.head<2>().norm(), truth.step_depth, 1e-9);
    }
  }
}

TEST(SimStairs, the_robot_meets_ascending_stairs_below_and_descending_ones_above) {
  StairSpec spec;
  spec.position = {1.5, 0.5};
  EXPECT_NEAR((build_flight(spec).truth.anchor - Vector3d{1.5, 0.5, 0.17}).norm(), 0, 1e-9);
  spec.descending = true;
  spec.heading_rad = std::numbers::pi;
  const auto down = build_flight(spec).truth;
  EXPECT_NEAR((down.anchor - Vector3d{1.5, 0.5, 0.0}).norm(), 0, 1e-9);
  EXPECT_NEAR(down.nosings.front().left.z(), -9 * 0.17, 1e-9);
  EXPECT_GT(down.nosings.front().left.x(), 1.5 + 8 * 0.29);
}

TEST(SimStairs, the_anchor_is_at_the_only_railing) {
  StairSpec spec;
  spec.position = {2.0, 0.0};
  spec.railing_left = true;
  auto truth = build_flight(spec).truth;
  EXPECT_EQ(truth.anchor_side, detect::AnchorSide::Left);
  EXPECT_NEAR((truth.anchor - Vector3d{2.0, 0.6, 0.17}).norm(), 0, 1e-9);
  spec.railing_right = true;
  truth = build_flight(spec).truth;
  EXPECT_EQ(truth.anchor_side, detect::AnchorSide::Middle);
  EXPECT_NEAR(truth.anchor.y(), 0.0, 1e-9);
}

TEST(SimStairs, a_riser_stands_back_by_the_overhang) {
  StairSpec spec;
  spec.position = {2.0, 0.0};
  for (const double overhang : {0.0, 0.025}) {
    SCOPED_TRACE(overhang);
    spec.overhang_m = overhang;
    const Bvh bvh{build_flight(spec).mesh};
    const double low = bvh.cast({0.0F, 0.1F, 0.05F}, {1, 0, 0}, 10.0F).range_m;
    const double lip = bvh.cast({0.0F, 0.1F, 0.16F}, {1, 0, 0}, 10.0F).range_m;
    EXPECT_NEAR(low, 2.0 + overhang, 1e-5);
    EXPECT_NEAR(lip, 2.0, 1e-5);
  }
}

TEST(SimStairs, one_sees_through_open_risers) {
  StairSpec spec;
  spec.position = {2.0, 0.0};
  spec.open_risers = true;
  EXPECT_EQ(Bvh{build_flight(spec).mesh}.cast({0.0F, 0.0F, 0.05F}, {1, 0, 0}, 30.0F).surface, kNoSurface);
  spec.open_risers = false;
  EXPECT_NE(Bvh{build_flight(spec).mesh}.cast({0.0F, 0.0F, 0.05F}, {1, 0, 0}, 30.0F).surface, kNoSurface);
}

TEST(SimStairs, refuses_what_cannot_be_built) {
  const auto problem = [](auto change) {
    StairSpec spec;
    change(spec);
    return spec.problem();
  };
  EXPECT_EQ(problem([](StairSpec&) {}), "");
  EXPECT_NE(problem([](StairSpec& s) { s.steps = 0; }).find("steps"), std::string::npos);
  EXPECT_NE(problem([](StairSpec& s) { s.height_m = std::nan(""); }).find("height_m"), std::string::npos);
  EXPECT_NE(problem([](StairSpec& s) { s.turn_per_step_rad = 0.5; }).find("spiral"), std::string::npos);
  EXPECT_NE(problem([](StairSpec& s) { s.height_offsets_m = {0.1}; }).find("offsets"), std::string::npos);
  EXPECT_NE(problem([](StairSpec& s) {
              s.steps = 2, s.depth_offsets_m = {0.3, 0.0};
            }).find("step 2"),
            std::string::npos);
  StairSpec bad;
  bad.width_m = -1;
  EXPECT_THROW(build_flight(bad), std::invalid_argument);
}

TEST(SimScene, the_floor_opens_above_descending_stairs_and_nowhere_else) {
  SceneSpec spec;
  spec.stairs.resize(1);
  spec.stairs[0].descending = true;
  spec.stairs[0].position = {1.0, 0.0};
  spec.stairs[0].heading_rad = std::numbers::pi;
  spec.room.height_m = 15.0;
  const Scene scene = build_scene(spec);
  const Bvh bvh{scene.mesh};
  const auto floor_at = [&](double x, double y) {
    return 10.0 - bvh.cast({static_cast<float>(x), static_cast<float>(y), 10.0F}, {0, 0, -1}, 100.0F).range_m;
  };
  EXPECT_NEAR(floor_at(0.0, 0.0), 0.0, 1e-5);
  EXPECT_NEAR(floor_at(0.99, 0.0), 0.0, 1e-5);
  EXPECT_NEAR(floor_at(1.01, 0.0), -0.17, 1e-5);
  EXPECT_NEAR(floor_at(1.5, 0.7), 0.0, 1e-5);
  EXPECT_NEAR(floor_at(4.5, 0.0), -1.7, 1e-5);
  EXPECT_NEAR(floor_at(6.0, 0.0), 0.0, 1e-5);
}

TEST(SimScene, the_ceiling_opens_above_high_stairs) {
  SceneSpec spec;
  spec.stairs.resize(1);
  const Bvh bvh{build_scene(spec).mesh};
  const auto free_height = [&](double x) {
    return 2.0 + bvh.cast({static_cast<float>(x), 0.0F, 2.0F}, {0, 0, 1}, 100.0F).range_m;
  };
  EXPECT_NEAR(free_height(1.9), 2.8, 1e-5);
  EXPECT_NEAR(free_height(4.5), 1.7 + 2.1, 1e-5);
}

TEST(SimScene, refuses_stairs_outside_the_room_and_things_on_the_robot) {
  SceneSpec spec;
  spec.stairs.resize(1);
  spec.stairs[0].position = {5.0, 0.0};
  EXPECT_NE(spec.problem().find("does not fit"), std::string::npos);
  spec.stairs[0].position = {0.1, 0.0};
  EXPECT_NE(spec.problem().find("robot"), std::string::npos);
  spec.stairs.clear();
  spec.furniture = {{FurnitureKind::Box, {0.2, 0.2}, 0.0, {0.5, 0.5, 0.5}, 0.0}};
  EXPECT_NE(spec.problem().find("furniture[0]"), std::string::npos);
  EXPECT_THROW(build_scene(spec), std::invalid_argument);
}

TEST(SimFurniture, every_kind_fills_its_box_and_no_more) {
  for (std::size_t i = 0; i < kFurnitureKinds; ++i) {
    const auto kind = static_cast<FurnitureKind>(i);
    SCOPED_TRACE(to_string(kind));
    EXPECT_EQ(furniture_kind(to_string(kind)), kind);
    const Vector3d size = usual_size(kind);
    const Mesh mesh = build_furniture({kind, {1.0, 2.0}, std::numbers::pi / 2, size, 0.5});
    Eigen::AlignedBox3d box;
    for (const auto& triangle : mesh.triangles()) {
      for (const auto& corner : triangle.corners) box.extend(corner);
    }
    const Vector3d turned{size.y(), size.x(), size.z()};
    EXPECT_LE((box.sizes() - turned).maxCoeff(), 0.02);
    EXPECT_GE((box.sizes() - turned).minCoeff(), -0.13);
    EXPECT_NEAR(box.max().z(), 0.5 + size.z(), 1e-9);
  }
}

}  // namespace
}  // namespace stairway::sim
