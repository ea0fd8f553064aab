// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "detector/spot.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

namespace stairway::detect {
namespace {

constexpr double kSpread_rad = 6e-3;
constexpr double kSeparation_m = 0.7;
const Backdrop kNothing{.inverse_per_m = std::numeric_limits<double>::quiet_NaN()};

/// An upright face at 2 m up to the horizon, another `behind_m` farther above it.
std::vector<VisibleFace> edge_at_horizon(double behind_m) {
  return {{.begin_rad = -1.0, .end_rad = 0.0, .kind = VisibleFace::Kind::Upright, .place_m = 2.0, .step = 0},
          {.begin_rad = 0.0, .end_rad = 1.0, .kind = VisibleFace::Kind::Upright, .place_m = 2.0 + behind_m, .step = 1}};
}

TEST(Spot, has_shares_that_grow_evenly_from_none_to_all) {
  EXPECT_EQ(share_below_chord(-1.5), 0.0);
  EXPECT_EQ(share_below_chord(1.0), 1.0);
  EXPECT_DOUBLE_EQ(share_below_chord(0.0), 0.5);
  double before = 0.0;
  for (double x = -1.0; x <= 1.0; x += 0.01) {
    EXPECT_GE(share_below_chord(x), before);
    EXPECT_NEAR(share_below_chord(x) + share_below_chord(-x), 1.0, 1e-12);
    before = share_below_chord(x);
  }
}

TEST(Spot, on_one_face_measures_its_range_along_the_beam) {
  const SpotEcho echo = echo_of(edge_at_horizon(0.3), -0.1, kSpread_rad, kNothing, kSeparation_m);
  ASSERT_TRUE(echo.is_known);
  EXPECT_FALSE(echo.is_mixed);
  EXPECT_NEAR(echo.range_m, 2.0 / std::cos(0.1), 1e-12);
}

TEST(Spot, on_two_near_faces_measures_the_mean_by_area) {
  const SpotEcho half = echo_of(edge_at_horizon(0.3), 0.0, kSpread_rad, kNothing, kSeparation_m);
  ASSERT_TRUE(half.is_known);
  EXPECT_TRUE(half.is_mixed);
  EXPECT_NEAR(half.range_m, 2.15, 1e-4);
  EXPECT_NEAR(half.spread_m, 0.3, 1e-4);
  const SpotEcho more = echo_of(edge_at_horizon(0.3), 0.5 * kSpread_rad, kSpread_rad, kNothing, kSeparation_m);
  EXPECT_NEAR(more.range_m, 2.0 + 0.3 * share_below_chord(0.5), 1e-4);
}

TEST(Spot, on_two_far_faces_measures_the_larger_part) {
  const SpotEcho echo = echo_of(edge_at_horizon(2.0), -0.2 * kSpread_rad, kSpread_rad, kNothing, kSeparation_m);
  ASSERT_TRUE(echo.is_known);
  EXPECT_TRUE(echo.is_split);
  EXPECT_NEAR(echo.near_share, share_below_chord(0.2), 1e-9);
  EXPECT_NEAR(echo.range_m, 2.0, 1e-4);
  EXPECT_NEAR(echo.far_m, 4.0, 1e-4);
}

TEST(Spot, says_so_where_nobody_knows_whether_two_faces_answer_together) {
  EXPECT_FALSE(echo_of(edge_at_horizon(0.7), 0.0, kSpread_rad, kNothing, kSeparation_m).is_known);
}

TEST(Spot, knows_what_lies_past_the_flight_only_by_the_backdrop) {
  std::vector<VisibleFace> faces = edge_at_horizon(0.0);
  faces[1].kind = VisibleFace::Kind::Beyond;
  EXPECT_FALSE(echo_of(faces, 0.0, kSpread_rad, kNothing, kSeparation_m).is_known);
  const Backdrop wall{.inverse_per_m = 1.0 / 2.4, .slope_per_m = 0.0, .elevation_rad = 0.0};
  const SpotEcho echo = echo_of(faces, 0.0, kSpread_rad, wall, kSeparation_m);
  ASSERT_TRUE(echo.is_known);
  EXPECT_NEAR(echo.range_m, 2.2, 1e-4);
  EXPECT_TRUE(echo_of(faces, 0.1, kSpread_rad, wall, kSeparation_m).is_past);
}

TEST(Spot, says_nothing_where_it_touches_what_nobody_knows) {
  std::vector<VisibleFace> faces = edge_at_horizon(0.0);
  faces[1].kind = VisibleFace::Kind::Unknown;
  EXPECT_FALSE(echo_of(faces, 0.0, kSpread_rad, kNothing, kSeparation_m).is_known);
  EXPECT_TRUE(echo_of(faces, -2.0 * kSpread_rad, kSpread_rad, kNothing, kSeparation_m).is_known);
  EXPECT_FALSE(echo_of(faces, 1.5, kSpread_rad, kNothing, kSeparation_m).is_known) << "no face there";
}

TEST(Spot, of_no_width_meets_one_face) {
  EXPECT_NEAR(echo_of(edge_at_horizon(0.3), -1e-6, 0.0, kNothing, kSeparation_m).range_m, 2.0, 1e-5);
  EXPECT_NEAR(echo_of(edge_at_horizon(0.3), 1e-6, 0.0, kNothing, kSeparation_m).range_m, 2.3, 1e-5);
}

}  // namespace
}  // namespace stairway::detect
