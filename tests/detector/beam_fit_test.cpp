// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "detector/beam_fit.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "detector/flight_ends.hpp"
#include "tests/detector/scene_fixtures.hpp"

namespace stairway::detect {
namespace {

constexpr double kPeriod_s = 6.0;

struct Seen {
  test::SimulatedRoom room;
  BeamFitStart start;
  StairCorridor corridor;
};

/// A flight, and where a fit to its steps may have left it: 4 mm and half a degree off.
Seen look_at(const sim::StairSpec& flight, double distance_m) {
  test::SimulatedRoom room = test::simulate(flight, distance_m, 0.2, kPeriod_s);
  BeamFitStart start;
  start.model.height_m = room.truth.step_height + 0.0005;
  start.model.depth_m = room.truth.step_depth - 0.001;
  start.model.nosing = room.truth.nosings.front().middle() + Eigen::Vector3d(0.004, 0.0, -0.003);
  const double heading = room.truth.heading + 0.009;
  start.model.descent = -Eigen::Vector3d(std::cos(heading), std::sin(heading), 0.0);
  start.sides = {-0.5 * room.truth.width, 0.5 * room.truth.width};
  start.last = flight.steps - 1;
  StairCorridor corridor(room.cloud, start.model, start.sides);
  return {std::move(room), start, std::move(corridor)};
}

void expect_truth(const BeamFit& fit, const Stairway& truth, double height_m, double depth_m, double along_m) {
  EXPECT_NEAR(fit.model.height_m, truth.step_height, height_m);
  EXPECT_NEAR(fit.model.depth_m, truth.step_depth, depth_m);
  EXPECT_NEAR(std::atan2(-fit.model.descent.y(), -fit.model.descent.x()), truth.heading, 0.004);
  const Eigen::Vector3d off = fit.model.nosing - truth.nosings.front().middle();
  EXPECT_NEAR(off.dot(fit.model.descent), 0.0, along_m);
  EXPECT_NEAR(off.z(), 0.0, along_m);
}

TEST(BeamFit, comes_closer_than_a_tenth_of_the_noise_to_closed_and_open_flights) {
  for (const bool open : {false, true}) {
    for (const double distance_m : {1.0, 2.5}) {
      SCOPED_TRACE(::testing::Message() << (open ? "open" : "closed") << " at " << distance_m << " m");
      sim::StairSpec flight;
      flight.open_risers = open;
      const Seen seen = look_at(flight, distance_m);
      const std::optional<BeamFit> fit = fit_beams(seen.corridor, seen.start, {});
      ASSERT_TRUE(fit);
      expect_truth(*fit, seen.room.truth, open ? 0.0008 : 0.0005, open ? 0.0016 : 0.0006, 0.003);
      EXPECT_FALSE(are_irregular(fit->offsets, true));
    }
  }
}

TEST(BeamFit, finds_overhangs_by_their_lips) {
  for (const double overhang_m : {0.0, 0.025}) {
    sim::StairSpec flight;
    flight.overhang_m = overhang_m;
    const Seen seen = look_at(flight, 1.5);
    const std::optional<BeamFit> fit = fit_beams(seen.corridor, seen.start, {});
    ASSERT_TRUE(fit);
    EXPECT_NEAR(fit->model.overhang_m, overhang_m, 0.002);
    expect_truth(*fit, seen.room.truth, 0.0005, 0.0006, 0.003);
  }
}

TEST(BeamFit, sees_for_itself_whether_risers_are_open) {
  for (const bool open : {false, true}) {
    sim::StairSpec flight;
    flight.open_risers = open;
    const Seen seen = look_at(flight, 1.5);
    const std::optional<BeamFit> fit = fit_beams(seen.corridor, seen.start, {});
    ASSERT_TRUE(fit);
    EXPECT_EQ(fit->shape.open_risers, open);
  }
}

TEST(BeamFit, finds_the_one_step_that_is_off) {
  sim::StairSpec flight;
  flight.height_offsets_m.assign(10, 0.0);
  flight.height_offsets_m[3] = 0.009;
  const Seen seen = look_at(flight, 2.0);
  const std::optional<BeamFit> fit = fit_beams(seen.corridor, seen.start, {});
  ASSERT_TRUE(fit);
  ASSERT_EQ(fit->offsets.size(), 10U);
  ASSERT_TRUE(fit->offsets[3].up && fit->offsets[2].up && fit->offsets[4].up);
  EXPECT_NEAR(fit->offsets[3].up->value - 0.5 * (fit->offsets[2].up->value + fit->offsets[4].up->value), 0.009, 0.0015);
}

// The third step's front has gone where the beams drawn for even steps do not look.
TEST(BeamFit, follows_steps_that_are_far_from_even) {
  sim::StairSpec flight;
  flight.height_offsets_m = {0.0, 0.02, -0.025, 0.03, -0.02, 0.0, 0.045, 0.01, -0.03, 0.0};
  Seen seen = look_at(flight, 2.0);
  for (int i = 0; i < 10; ++i)
    seen.start.offsets.push_back(
        {.number = i, .up = Estimate{flight.height_offsets_m[static_cast<std::size_t>(i)] + 0.003, 0.002}});
  const std::optional<BeamFit> fit = fit_beams(seen.corridor, seen.start, {});
  ASSERT_TRUE(fit);
  EXPECT_TRUE(are_irregular(fit->offsets));
  double sum = 0.0;
  for (std::size_t i = 0; i < 10; ++i) {
    ASSERT_TRUE(fit->offsets[i].up) << "step " << i;
    const double up = (fit->model.step(static_cast<double>(i)).nosing.z() + fit->offsets[i].up->value);
    sum += std::abs(up - seen.room.truth.nosings[i].middle().z());
  }
  EXPECT_LT(sum / 10.0, 0.0015);
}

TEST(BeamFit, is_as_sure_of_the_model_however_uneven_the_steps) {
  sim::StairSpec even;
  sim::StairSpec uneven;
  uneven.height_offsets_m = {0.0, 0.02, -0.025, 0.03, -0.02, 0.0, 0.025, 0.01, -0.03, 0.0};
  const Seen of_even = look_at(even, 2.0);
  const Seen of_uneven = look_at(uneven, 2.0);
  BeamFitStart start = of_uneven.start;
  for (int i = 0; i < 10; ++i)
    start.offsets.push_back({.number = i, .up = Estimate{uneven.height_offsets_m[static_cast<std::size_t>(i)], 0.002}});
  const std::optional<BeamFit> a = fit_beams(of_even.corridor, of_even.start, {});
  const std::optional<BeamFit> b = fit_beams(of_uneven.corridor, start, {});
  ASSERT_TRUE(a && b);
  EXPECT_LT(b->even_sigmas.height_m, 3.0 * a->even_sigmas.height_m);
  EXPECT_GT(b->sigmas.height_m, 5.0 * b->even_sigmas.height_m);
}

TEST(BeamFit, has_nothing_to_say_without_a_sensor_of_spirals_or_of_no_steps) {
  const Seen seen = look_at({}, 2.0);
  test::SimulatedRoom merged = seen.room;
  merged.cloud.sensor_origin.reset();
  const StairCorridor nowhere(merged.cloud, seen.start.model, seen.start.sides);
  EXPECT_FALSE(fit_beams(nowhere, seen.start, {}));
  BeamFitStart spiral = seen.start;
  spiral.model.turn_rad = 0.3;
  EXPECT_FALSE(fit_beams(seen.corridor, spiral, {}));
  BeamFitStart none = seen.start;
  none.last = none.first - 1;
  EXPECT_FALSE(fit_beams(seen.corridor, none, {}));
}

TEST(BeamFit, does_not_explain_a_flight_that_is_not_there_unless_it_finds_the_one_nearby) {
  const Seen seen = look_at({}, 2.0);
  const Eigen::Vector3d truth = seen.start.model.nosing;
  for (const Eigen::Vector3d& off : {Eigen::Vector3d(0.15, 0.0, 0.08), Eigen::Vector3d(0.0, 0.0, 0.085),
                                     Eigen::Vector3d(0.1, 0.0, 0.0), Eigen::Vector3d(-0.12, 0.0, 0.05)}) {
    Seen wrong = seen;
    wrong.start.model.nosing += off;
    const std::optional<BeamFit> fit = fit_beams(wrong.corridor, wrong.start, {});
    if (!fit || fit->explained < 0.75) continue;
    const Eigen::Vector3d apart = fit->model.nosing - truth;
    const double steps = std::round(apart.z() / seen.start.model.height_m);
    EXPECT_NEAR(apart.z(), steps * seen.start.model.height_m, 0.01) << off.transpose();
    EXPECT_NEAR(apart.dot(fit->model.descent), -steps * seen.start.model.depth_m, 0.02) << off.transpose();
  }
}

FlightEnds ends_of(const Seen& seen, const BeamFit& fit, double off_m) {
  const StepFrame frame = fit.model.step(seen.start.first);
  const StepPoint sensor = frame.to_step(*seen.corridor.sensor());
  const Interval about{seen.start.sides.low - off_m, seen.start.sides.high + off_m};
  return find_flight_ends(seen.corridor, frame, sensor, visible_faces(fit.shape, {sensor.u, sensor.z}), about, {},
                          0.010);
}

TEST(FlightEnds, are_found_behind_balusters_and_from_a_wrong_guess) {
  for (const bool railing : {false, true}) {
    for (const double off_m : {-0.2, 0.0, 0.2}) {
      SCOPED_TRACE(::testing::Message() << (railing ? "railing, " : "") << "guess off by " << off_m);
      sim::StairSpec flight;
      flight.railing_left = flight.railing_right = railing;
      const Seen seen = look_at(flight, 1.5);
      const std::optional<BeamFit> fit = fit_beams(seen.corridor, seen.start, {});
      ASSERT_TRUE(fit);
      const FlightEnds ends = ends_of(seen, *fit, off_m);
      ASSERT_TRUE(ends.left && ends.right);
      EXPECT_NEAR(ends.left->value - ends.right->value, flight.width_m, 0.008);
      EXPECT_GT(ends.left->sigma, 0.0);
    }
  }
}

TEST(FlightEnds, are_not_made_up_where_no_beam_passes_them) {
  const Seen seen = look_at({}, 1.5);
  const std::optional<BeamFit> fit = fit_beams(seen.corridor, seen.start, {});
  ASSERT_TRUE(fit);
  const FlightEnds ends = ends_of(seen, *fit, -1.1 * seen.start.sides.high);
  EXPECT_TRUE(!ends.left || ends.left->value < 0.7);
  scan::PointCloud nothing = seen.room.cloud;
  nothing.points.clear();
  const StairCorridor empty(nothing, seen.start.model, seen.start.sides);
  const StepFrame frame = fit->model.step(0);
  const StepPoint sensor = frame.to_step(*empty.sensor());
  const FlightEnds none = find_flight_ends(empty, frame, sensor, visible_faces(fit->shape, {sensor.u, sensor.z}),
                                           seen.start.sides, {}, 0.010);
  EXPECT_FALSE(none.left || none.right);
}

}  // namespace
}  // namespace stairway::detect
