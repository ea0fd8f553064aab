// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "detector/moved_flight.hpp"

#include <gtest/gtest.h>

namespace stairway::detect {
namespace {

constexpr int kSteps = 4;
constexpr double kSpot_rad = 6.65e-3;

FlightBase some_base() {
  FlightBase base;
  base.model.height_m = 0.17;
  base.model.depth_m = 0.29;
  base.model.descent = -Eigen::Vector3d(0.8, 0.6, 0.0);
  base.model.nosing = {2.0, 1.0, 0.17};
  base.first = -1;
  return base;
}

TEST(MovedFlight, begins_as_its_model) {
  const FlightBase base = some_base();
  const StairModel model = unmoved(base, kSteps, {}, kSpot_rad).model(base);
  EXPECT_NEAR((model.nosing - base.model.nosing).norm(), 0.0, 1e-12);
  EXPECT_NEAR((model.descent - base.model.descent).norm(), 0.0, 1e-12);
  EXPECT_EQ(model.height_m, base.model.height_m);
}

TEST(MovedFlight, shows_the_nosings_of_its_model) {
  const FlightBase base = some_base();
  FlightUnknowns change = FlightUnknowns::Zero();
  change[kAlong] = 0.02;
  change[kUp] = -0.01;
  change[kDepth] = 0.003;
  change[kRise] = 0.002;
  const MovedFlight flight = unmoved(base, kSteps, {}, kSpot_rad).changed(change);
  const StairProfileShape shape = flight.shape(base);
  const StepFrame lowest = base.model.step(base.first);
  ASSERT_EQ(shape.nosings.size(), 4U);
  for (int i = 0; i < kSteps; ++i) {
    const StepPoint at = lowest.to_step(flight.model(base).step(base.first + i).nosing);
    EXPECT_NEAR(shape.nosings[static_cast<std::size_t>(i)].x(), at.u, 1e-12);
    EXPECT_NEAR(shape.nosings[static_cast<std::size_t>(i)].y(), at.z, 1e-12);
  }
}

TEST(MovedFlight, takes_offsets_of_its_steps_and_moves_single_ones) {
  const FlightBase base = some_base();
  const std::vector<StepOffset> offsets{{.number = 0, .up = Estimate{0.012, 0.001}, .ahead = std::nullopt},
                                        {.number = 1, .up = Estimate{0.2, 0.001}, .ahead = Estimate{-0.004, 0.001}},
                                        {.number = 99, .up = Estimate{0.01, 0.001}, .ahead = std::nullopt}};
  const MovedFlight flight = unmoved(base, kSteps, offsets, kSpot_rad);
  EXPECT_EQ(flight.up[1], 0.012) << "step 0 is the second";
  EXPECT_EQ(flight.up[2], kMostUneven_m) << "no step is off by 0.2 m";
  EXPECT_EQ(flight.ahead[2], -0.004);
  const MovedFlight moved = flight.with_step_moved(kSteps + 3, 0.001);
  EXPECT_EQ(moved.up[3], 0.001);
  EXPECT_EQ(moved.ahead[3], 0.0);
  EXPECT_NEAR(moved.shape(base).nosings[3].y() - flight.shape(base).nosings[3].y(), 0.001, 1e-12);
}

TEST(MovedFlight, keeps_within_what_stairs_and_spots_may_be) {
  FlightUnknowns change = FlightUnknowns::Constant(-1.0);
  const MovedFlight small = unmoved(some_base(), kSteps, {}, kSpot_rad).changed(change);
  EXPECT_EQ(small.unknowns[kOverhang], 0.0);
  EXPECT_GT(small.unknowns[kThickness], 0.0);
  EXPECT_GT(small.unknowns[kSpot], 0.0);
  const MovedFlight large = unmoved(some_base(), kSteps, {}, kSpot_rad).changed(-change);
  EXPECT_LT(large.unknowns[kOverhang], 0.1);
  EXPECT_LT(large.unknowns[kThickness], 0.1);
}

}  // namespace
}  // namespace stairway::detect
