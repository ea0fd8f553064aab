// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <utility>

#include "tools/sim/outline.hpp"
#include "tools/sim/random.hpp"

namespace stairway::sim {
namespace {

double total_area(const std::vector<Outline>& pieces) {
  double sum = 0;
  for (const auto& piece : pieces) sum += area(piece);
  return sum;
}

TEST(SimOutline, subtracting_leaves_the_area_outside_in_pieces_that_do_not_overlap) {
  const Outline room = rectangle({1, 0}, {8, 6}, 0);
  for (const double yaw : {0.0, 0.3, 1.2}) {
    SCOPED_TRACE(yaw);
    const Outline hole = rectangle({0.5, 0.5}, {2, 1}, yaw);
    const auto pieces = subtract(room, hole);
    EXPECT_NEAR(total_area(pieces), 48 - 2, 1e-9);
    for (std::size_t i = 0; i < pieces.size(); ++i) {
      EXPECT_FALSE(overlap(pieces[i], hole));
      for (std::size_t j = 0; j < i; ++j) EXPECT_FALSE(overlap(pieces[i], pieces[j]));
    }
  }
}

TEST(SimOutline, subtracting_something_elsewhere_or_everything) {
  const Outline room = rectangle({0, 0}, {2, 2}, 0);
  EXPECT_NEAR(total_area(subtract(room, rectangle({9, 0}, {1, 1}, 0.2))), 4.0, 1e-9);
  EXPECT_NEAR(total_area(subtract(room, rectangle({0, 0}, {5, 5}, 0.2))), 0.0, 1e-9);
  EXPECT_NEAR(total_area(subtract(room, rectangle({1, 0}, {2, 9}, 0.0))), 2.0, 1e-9);
}

TEST(SimOutline, a_hole_that_is_cut_is_missing_in_every_piece) {
  std::vector<Outline> pieces{rectangle_between({0, 0}, {1, 2}), rectangle_between({1, 0}, {3, 2})};
  const Outline hole = rectangle_between({1.5, 1.5}, {0.5, 0.5});
  EXPECT_TRUE(overlap_any(hole, pieces));
  cut(pieces, hole);
  EXPECT_NEAR(total_area(pieces), 6 - 1, 1e-9);
  EXPECT_FALSE(overlap_any(hole, pieces));
}

TEST(SimOutline, a_rectangle_turns_left_whichever_corners_are_given) {
  for (const auto& [corner, opposite] : {std::pair<Eigen::Vector2d, Eigen::Vector2d>{{1, 2}, {4, 4}}, {{4, 2}, {1, 4}}})
    EXPECT_NEAR(area(rectangle_between(corner, opposite)), 6.0, 1e-12);
}

TEST(SimOutline, hull_holds_all_points_and_turns_left) {
  Random random{5};
  std::vector<Eigen::Vector2d> points;
  for (int i = 0; i < 200; ++i) points.emplace_back(random.normal(), random.normal());
  const Outline hull = convex_hull(points);
  EXPECT_GT(area(hull), 0);
  for (std::size_t i = 0; i < hull.size(); ++i) {
    const Eigen::Vector2d side = hull[(i + 1) % hull.size()] - hull[i];
    for (const auto& p : points) {
      const Eigen::Vector2d to_point = p - hull[i];
      EXPECT_GE((side.x() * to_point.y() - side.y() * to_point.x()) / side.norm(), -2e-7) << "beyond the resolution";
    }
  }
}

TEST(SimOutline, growing_moves_every_side_outward) {
  EXPECT_NEAR(area(grown(rectangle({3, 1}, {2, 1}, 0.7), 0.5)), 3.0 * 2.0, 1e-9);
}

TEST(SimOutline, touching_is_not_overlapping) {
  const Outline a = rectangle({0, 0}, {2, 2}, 0);
  EXPECT_FALSE(overlap(a, rectangle({2, 0}, {2, 2}, 0)));
  EXPECT_TRUE(overlap(a, rectangle({1.9, 0}, {2, 2}, 0)));
  EXPECT_TRUE(overlap(a, rectangle({0, 0}, {0.1, 0.1}, 1)));
}

TEST(Outline, hull_keeps_its_corners_when_rounding_tilts_its_sides) {
  std::vector<Eigen::Vector2d> points;
  for (int i = 0; i <= 8; ++i) {
    const double jitter = (i * 7 % 5 - 2) * 1e-16;
    points.emplace_back(1.0 + jitter, 0.4 * i);
    points.emplace_back(2.0 - jitter, 0.4 * i);
  }
  EXPECT_NEAR(area(convex_hull(points)), 3.2, 1e-6);
}

}  // namespace
}  // namespace stairway::sim
