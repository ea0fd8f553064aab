// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "tools/sim/building.hpp"
#include "tools/sim/bvh.hpp"
#include "tools/sim/merged_sweeps.hpp"
#include "tools/sim/scene_file.hpp"

namespace stairway::sim {
namespace {

float height_below(const Bvh& bvh, const Eigen::Vector3d& p) {
  return static_cast<float>(p.z()) - bvh.cast(p.cast<float>(), {0, 0, -1}, 100.0F).range_m;
}

TEST(SimBuilding, has_two_flights_between_storeys_in_every_stairwell) {
  const Building building = build_building({.storeys = 4, .stairwells = 2});
  const auto& truths = building.scene.truths;
  ASSERT_EQ(truths.size(), 3U * 2U * 2U);
  const double storey = 2 * truths[0].step_height * static_cast<double>(truths[0].nosings.size());
  for (std::size_t i = 0; i < truths.size(); i += 2) {
    SCOPED_TRACE(i);
    const double foot = truths[i].nosings.front().left.z() - truths[i].step_height;
    EXPECT_NEAR(std::remainder(foot, storey), 0.0, 1e-9) << "the first flight stands on a floor";
    EXPECT_NEAR(truths[i + 1].nosings.front().left.z() - truths[i + 1].step_height, truths[i].nosings.back().left.z(),
                1e-9)
        << "the second flight begins where the first one ends";
    EXPECT_NEAR(truths[i + 1].nosings.back().left.z(), foot + storey, 1e-9);
    EXPECT_NEAR(std::abs(std::remainder(truths[i + 1].heading - truths[i].heading, 2 * M_PI)), M_PI, 1e-9);
  }
}

TEST(SimBuilding, leaves_headroom_on_every_step) {
  const Building building = build_building({.storeys = 3, .stairwells = 2, .seed = 5});
  const Bvh bvh{building.scene.mesh};
  for (const auto& truth : building.scene.truths) {
    const Eigen::Vector3d ahead{std::cos(truth.heading), std::sin(truth.heading), 0.0};
    for (std::size_t i = 0; i + 1 < truth.nosings.size(); ++i) {
      const auto& nosing = truth.nosings[i];
      const Eigen::Vector3d p = (nosing.left + nosing.right) / 2 + 0.1 * ahead;
      const Eigen::Vector3d up = p + Eigen::Vector3d{0, 0, 0.05};
      EXPECT_NEAR(height_below(bvh, up), p.z(), 1e-4);
      EXPECT_GT(bvh.cast(up.cast<float>(), {0, 0, 1}, 100.0F).range_m, 1.85F);
    }
  }
}

TEST(SimBuilding, robots_stand_on_floors_with_space_around_them) {
  const Building building = build_building({.storeys = 3, .rooms = 5, .stairwells = 2, .seed = 3});
  EXPECT_EQ(building.stands.size(), 3U * 10U + 2U * 2U * 2U);
  const Bvh bvh{building.scene.mesh};
  for (const Stand& stand : building.stands) {
    const Eigen::Vector3d eye = stand.position + Eigen::Vector3d{0, 0, 0.5};
    EXPECT_NEAR(height_below(bvh, eye), stand.position.z(), 1e-4);
    for (int i = 0; i < 8; ++i) {
      const auto angle = static_cast<float>(i * M_PI / 4);
      EXPECT_GT(bvh.cast(eye.cast<float>(), {std::cos(angle), std::sin(angle), 0}, 100.0F).range_m, 0.25F);
    }
  }
}

TEST(SimBuilding, can_be_as_high_and_as_long_as_its_specification_allows) {
  constexpr int kMost = 20;
  for (const int rooms : {2, kMost}) {
    for (const int storeys : {2, 6, kMost}) {
      const BuildingSpec spec{.storeys = storeys, .rooms = rooms, .stairwells = 2, .seed = 1};
      ASSERT_EQ(spec.problem(), "");
      EXPECT_EQ(build_building(spec).scene.truths.size(), 4U * static_cast<std::size_t>(storeys - 1));
    }
  }
}

TEST(SimBuilding, differs_by_seed_and_repeats_itself) {
  const auto first = build_building({.seed = 1}).scene;
  EXPECT_EQ(first.mesh.triangles().size(), build_building({.seed = 1}).scene.mesh.triangles().size());
  EXPECT_EQ(first.truths[0].step_height, build_building({.seed = 1}).scene.truths[0].step_height);
  EXPECT_NE(first.truths[0].step_height, build_building({.seed = 2}).scene.truths[0].step_height);
}

TEST(SimBuilding, refuses_what_cannot_be_built) {
  EXPECT_NE(BuildingSpec{.storeys = 0}.problem(), "");
  EXPECT_NE(BuildingSpec{.rooms = 1}.problem(), "");
  EXPECT_THROW(build_building({.stairwells = 3}), std::invalid_argument);
}

TEST(SimMergedSweeps, lie_on_the_surfaces_wherever_they_were_taken) {
  const Scene scene = build_scene(load_scene("empty-room"));
  ScannerOptions scanner;
  scanner.noise_near_m = scanner.noise_far_m = 0.0;
  const std::vector<Stand> stands{{{1.0, 0.5, 0.0}, 0.7}, {{-2.0, -1.0, 0.4}, -2.0}};
  const auto cloud = simulate_merged(scene, stands, {}, scanner, {.disk_period_s = 0.5}, 1);
  EXPECT_FALSE(cloud.sensor_origin);
  ASSERT_GT(cloud.points.size(), 2U * 20U * 1000U);
  int off = 0;
  for (const auto& p : cloud.points) {
    const double distance = std::min({std::abs(p.x() + 4.0), std::abs(p.x() - 5.0), std::abs(p.y() + 3.0),
                                      std::abs(p.y() - 4.0), std::abs(p.z() - 0.0), std::abs(p.z() - 2.7)});
    off += distance > 0.0015;
  }
  EXPECT_LT(off, static_cast<int>(cloud.points.size() / 20)) << "but for mixed points in the corners";
}

TEST(SimMergedSweeps, have_noise_of_their_own_at_every_stand) {
  const Scene scene = build_scene(load_scene("empty-room"));
  const std::vector<Stand> twice{{}, {}};
  const auto cloud = simulate_merged(scene, twice, {}, {}, {.disk_period_s = 0.1}, 1);
  const std::size_t half = cloud.points.size() / 2;
  std::size_t equal = 0;
  for (std::size_t i = 0; i < half; ++i) equal += cloud.points[i] == cloud.points[i + half];
  EXPECT_LT(equal, half / 10);
}

}  // namespace
}  // namespace stairway::sim
