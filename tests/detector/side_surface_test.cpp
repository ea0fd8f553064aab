// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "detector/side_surface.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "tools/sim/random.hpp"

namespace stairway::detect {
namespace {

constexpr double kEnd_m = 0.6;
constexpr double kReach_m = 0.015;
constexpr double kFarthest_m = 0.9;
constexpr double kAside = 0.4;  // of a beam's way

/// Where a beam that would meet the face at a place goes on to beyond the end, from the face.
using BeyondEnd = double (*)(double out_m, sim::Random& random);

double to_wall(double out_m, sim::Random&) { return -out_m / kAside; }
double to_flank(double out_m, sim::Random&) { return out_m / kAside; }
double to_background(double, sim::Random& random) { return random.uniform(0.8, 1.2); }
double to_posts(double out_m, sim::Random& random) { return random.chance(0.3) ? -out_m / kAside : 1.0; }

std::vector<SideSight> sights_of(BeyondEnd beyond, std::uint64_t seed) {
  sim::Random random{seed};
  std::vector<SideSight> sights;
  for (int i = 0; i < 4000; ++i) {
    SideSight sight;
    sight.crossing_m = random.uniform(0.0, kFarthest_m);
    const double out_m = sight.crossing_m - kEnd_m;
    sight.farther_m = (out_m > 0.0 ? beyond(out_m, random) : 0.0) + 0.01 * random.normal();
    // A flank is seen from beside the flight.
    sight.ended_m = sight.crossing_m + (beyond == to_flank ? -kAside : kAside) * sight.farther_m;
    sights.push_back(sight);
  }
  return sights;
}

TEST(SideSurface, is_a_wall_or_a_flank_where_all_beams_past_the_end_meet_it) {
  for (const BeyondEnd beyond : {to_wall, to_flank}) {
    for (const double about_m : {kEnd_m - 0.03, kEnd_m, kEnd_m + 0.04}) {
      const std::optional<Estimate> surface = find_side_surface(sights_of(beyond, 1), about_m, kReach_m);
      ASSERT_TRUE(surface) << (beyond == to_wall ? "wall" : "flank") << " looked for at " << about_m;
      EXPECT_NEAR(surface->value, kEnd_m, 0.001);
      EXPECT_LT(surface->sigma, 0.001);
    }
  }
}

TEST(SideSurface, is_none_where_beams_pass_the_end_or_only_posts_stop_some) {
  EXPECT_FALSE(find_side_surface(sights_of(to_background, 2), kEnd_m, kReach_m));
  EXPECT_FALSE(find_side_surface(sights_of(to_posts, 3), kEnd_m, kReach_m));
  EXPECT_FALSE(find_side_surface({}, kEnd_m, kReach_m));
}

TEST(SideSurface, is_a_wall_behind_posts_too) {
  sim::Random random{6};
  std::vector<SideSight> sights = sights_of(to_wall, 6);
  constexpr double kPosts_m = kEnd_m - 0.06;
  for (SideSight& sight : sights) {
    if (sight.crossing_m < kPosts_m || !random.chance(0.5)) continue;
    sight.farther_m = -(sight.crossing_m - kPosts_m) / kAside;
    sight.ended_m = kPosts_m;
  }
  const std::optional<Estimate> surface = find_side_surface(sights, kEnd_m, kReach_m);
  ASSERT_TRUE(surface);
  EXPECT_NEAR(surface->value, kEnd_m, 0.001);
}

// Else faces that go on behind a row of posts would be taken for what stops the beams.
TEST(SideSurface, is_no_row_of_posts_that_the_faces_go_on_behind) {
  sim::Random random{4};
  std::vector<SideSight> sights;
  for (int i = 0; i < 4000; ++i) {
    SideSight sight{.crossing_m = random.uniform(0.0, kFarthest_m)};
    const double out_m = sight.crossing_m - kEnd_m;
    if (out_m > 0.0 && random.chance(0.3)) sight.farther_m = -out_m / kAside;
    sight.farther_m += 0.01 * random.normal();
    sight.ended_m = sight.crossing_m + kAside * sight.farther_m;
    sights.push_back(sight);
  }
  EXPECT_FALSE(find_side_surface(sights, kEnd_m, kReach_m));
}

TEST(SideSurface, is_looked_for_near_the_end_only) {
  EXPECT_FALSE(find_side_surface(sights_of(to_wall, 5), kEnd_m - 0.2, kReach_m));
}

}  // namespace
}  // namespace stairway::detect
