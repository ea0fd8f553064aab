// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "detector/plane_finder.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <numbers>
#include <numeric>

#include "tests/detector/part_fixtures.hpp"

namespace stairway::detect {
namespace {

struct Patch {
  scan::PointCloud cloud;
  PlaneRegion region;
};

// A rectangle `width` by `length`, tilted by `tilt_rad` about its long edge from lying (0) to standing (pi/2).
Patch patch(double width, double length, double tilt_rad) {
  Patch result;
  const Eigen::Vector3d slope(std::cos(tilt_rad), 0.0, std::sin(tilt_rad));
  test::add_rectangle(result.cloud, {2.0, -0.5 * width, 0.3}, {0, width, 0}, length * slope, 0.01);
  result.cloud.sensor_origin = Eigen::Vector3f(0, 0, 0.5F);
  std::vector<std::uint32_t> all(result.cloud.points.size());
  std::iota(all.begin(), all.end(), 0U);
  result.region = make_region(result.cloud.points, all, {-1, 0, 0.1});
  return result;
}

std::optional<StairPart> find(const Patch& p) { return find_stair_part(p.cloud, p.region); }

TEST(PlaneFinder, takes_what_is_as_large_and_as_level_as_a_step) {
  constexpr double kUpright = std::numbers::pi / 2;
  constexpr double kDegree = std::numbers::pi / 180;
  struct Case {
    const char* what;
    double width, length, tilt;
    std::optional<StairPart::Kind> expected;
  };
  const Case cases[] = {
      {"riser of 17 cm", 1.2, 0.17, kUpright, StairPart::Kind::Riser},
      {"riser of 23.5 cm", 1.2, 0.235, kUpright, StairPart::Kind::Riser},
      {"wall of 24.5 cm", 1.2, 0.245, kUpright, std::nullopt},
      {"riser leaning by 14 degrees", 1.2, 0.17, kUpright - 14 * kDegree, StairPart::Kind::Riser},
      {"ramp", 1.2, 0.17, kUpright - 16 * kDegree, std::nullopt},
      {"tread of 29 cm", 1.2, 0.29, 0.0, StairPart::Kind::Tread},
      {"tread of 39.5 cm", 1.2, 0.395, 0.0, StairPart::Kind::Tread},
      {"bench of 41 cm", 1.2, 0.41, 0.0, std::nullopt},
      {"tread tilted by 14 degrees", 1.2, 0.29, 14 * kDegree, StairPart::Kind::Tread},
      {"tread tilted by 16 degrees", 1.2, 0.29, 16 * kDegree, std::nullopt},
      {"floor", 3.0, 3.0, 0.0, std::nullopt},
      {"post", 0.1, 0.08, kUpright, std::nullopt},
  };
  for (const Case& c : cases) {
    SCOPED_TRACE(c.what);
    const std::optional<StairPart> part = find(patch(c.width, c.length, c.tilt));
    ASSERT_EQ(part.has_value(), c.expected.has_value());
    if (part) {
      EXPECT_EQ(part->kind, *c.expected);
    }
  }
}

TEST(PlaneFinder, measures_the_edges_of_a_riser) {
  const std::optional<StairPart> riser = find(patch(1.2, 0.17, std::numbers::pi / 2));
  ASSERT_TRUE(riser);
  EXPECT_NEAR(riser->bottom.z(), 0.30, 1e-3);
  EXPECT_NEAR(riser->top.z(), 0.47, 1e-3);
  EXPECT_NEAR(riser->width(), 1.2, 1e-3);
  EXPECT_NEAR(riser->facing.x(), -1.0, 1e-6) << "it faces the sensor";
  EXPECT_EQ(riser->facing.z(), 0.0);
}

TEST(PlaneFinder, measures_the_edges_of_a_tread_and_the_side_it_is_seen_from) {
  Patch seen = patch(1.2, 0.29, 0.0);
  const std::optional<StairPart> tread = find(seen);
  ASSERT_TRUE(tread);
  EXPECT_NEAR((tread->front - tread->back).norm(), 0.29, 1e-3);
  EXPECT_NEAR(tread->width(), 1.2, 1e-3);
  EXPECT_FALSE(tread->from_below);
  seen.cloud.sensor_origin = Eigen::Vector3f(0, 0, 0.1F);
  EXPECT_TRUE(find(seen)->from_below);
  seen.cloud.sensor_origin.reset();
  EXPECT_FALSE(find(seen)->from_below) << "nobody knows";
}

TEST(PlaneFinder, takes_a_horizontal_bar_for_an_edge_whatever_its_normal) {
  for (const double tilt : {0.0, 0.8, 1.57}) {
    const Patch bar = patch(1.0, 0.08, tilt);
    const std::optional<StairPart> edge = find_edge(bar.cloud, bar.region);
    ASSERT_TRUE(edge) << tilt;
    EXPECT_NEAR(std::abs(edge->facing.x()), 1.0, 1e-6);
  }
  EXPECT_FALSE(find_edge(patch(0.3, 0.08, 0.8).cloud, patch(0.3, 0.08, 0.8).region)) << "too short";
  EXPECT_FALSE(find_edge(patch(1.0, 0.30, 0.0).cloud, patch(1.0, 0.30, 0.0).region)) << "too thick";
}

}  // namespace
}  // namespace stairway::detect
