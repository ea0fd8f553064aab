// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tools/evaluation/accuracy.hpp"
#include "tools/evaluation/accuracy_bound.hpp"
#include "tools/evaluation/accuracy_run.hpp"
#include "tools/sim/angles.hpp"

namespace stairway::evaluation {
namespace {

sim::SceneSpec flight_ahead(double distance_m) {
  sim::StairSpec flight;
  flight.steps = 10;
  flight.height_m = 0.17;
  flight.depth_m = 0.29;
  flight.width_m = 1.2;
  flight.position = {distance_m, 0.0};
  sim::SceneSpec spec;
  spec.name = "ahead";
  spec.stairs = {flight};
  spec.room = {.low = {-4.0, -4.0}, .high = {distance_m + 7.0, 4.0}, .height_m = 4.2};
  return spec;
}

// Figures of an independent computation for a flight of ten steps, 0.5 m below the sensor.
TEST(AccuracyBound, agrees_with_figures_computed_independently) {
  const BoundOptions real{.angle_sigma_rad = 0.072 * sim::kDegree, .edge_sigma_rad = 1.3e-3, .stride = 8};
  constexpr double kTolerance = 0.25;
  struct Row {
    double distance_m;
    BoundOptions options;
    double height_mm, depth_mm;
  };
  const Row table[] = {{2.0, real, 0.040, 0.030}, {4.0, real, 0.090, 0.051}};
  for (const Row& row : table) {
    SCOPED_TRACE(::testing::Message() << row.distance_m << " m, spot " << row.options.spot_rad);
    const auto bound = accuracy_bound(sim::build_scene(flight_ahead(row.distance_m)), {}, row.options);
    ASSERT_TRUE(bound);
    EXPECT_NEAR(1e3 * bound->height_m, row.height_mm, kTolerance * row.height_mm);
    EXPECT_NEAR(1e3 * bound->depth_m, row.depth_mm, kTolerance * row.depth_mm);
  }
}

TEST(AccuracyBound, tells_ends_heading_and_place_too) {
  const auto bound = accuracy_bound(sim::build_scene(flight_ahead(2.0)), {},
                                    {.angle_sigma_rad = 0.072 * sim::kDegree, .edge_sigma_rad = 1.3e-3, .stride = 8});
  ASSERT_TRUE(bound);
  EXPECT_NEAR(bound->heading_rad / sim::kDegree, 0.011, 0.004);
  EXPECT_NEAR(1e3 * bound->along_m, 0.105, 0.04);
  EXPECT_NEAR(1e3 * bound->up_m, 0.098, 0.04);
  EXPECT_NEAR(1e3 * bound->width_m, 0.54, 0.2);
}

TEST(AccuracyBound, grows_with_noise_and_with_the_speed_of_the_disk) {
  const sim::Scene scene = sim::build_scene(flight_ahead(2.0));
  const BoundOptions slow{.disk_period_s = 10.0, .stride = 4};
  const BoundOptions fast{.disk_period_s = 5.0, .stride = 2};
  const auto usual = accuracy_bound(scene, {}, slow);
  const auto noisy = accuracy_bound(scene, {}, {.range_sigma_m = 0.020, .disk_period_s = 10.0, .stride = 4});
  const auto quick = accuracy_bound(scene, {}, fast);
  ASSERT_TRUE(usual && noisy && quick);
  EXPECT_GT(noisy->depth_m, 1.8 * usual->depth_m);
  EXPECT_GT(quick->depth_m, 1.2 * usual->depth_m);
}

TEST(AccuracyBound, is_lower_for_who_can_use_mixed_pixels) {
  const sim::Scene scene = sim::build_scene(flight_ahead(4.0));
  const auto dropped = accuracy_bound(scene, {}, {.disk_period_s = 10.0});
  const auto used = accuracy_bound(scene, {}, {.spot_rad = 0.0, .disk_period_s = 10.0});
  ASSERT_TRUE(dropped && used);
  EXPECT_LT(used->depth_m, 0.95 * dropped->depth_m);
}

TEST(AccuracyBound, is_told_for_straight_regular_flights_only) {
  sim::SceneSpec spiral = flight_ahead(2.0);
  spiral.stairs.front().turn_per_step_rad = 0.2;
  EXPECT_FALSE(accuracy_bound(sim::build_scene(spiral), {}, {.disk_period_s = 1.0}));
  sim::SceneSpec irregular = flight_ahead(2.0);
  irregular.stairs.front().height_offsets_m.assign(10, 0.01);
  EXPECT_FALSE(accuracy_bound(sim::build_scene(irregular), {}, {.disk_period_s = 1.0}));
}

// A robot that is rolled and pitched sees what a level one does, turned about the vertical by next to nothing.
TEST(LevelledTruths, keep_their_heights_and_places) {
  const sim::Scene scene = sim::build_scene(flight_ahead(2.0));
  sim::ScannerOptions scanner;
  scanner.robot_roll_rad = 3 * sim::kDegree;
  scanner.robot_pitch_rad = -3 * sim::kDegree;
  const detect::Stairway truth = levelled_truths(scene, scanner).front();
  EXPECT_NEAR(truth.nosings.front().middle().z(), 0.17, 1e-9);
  EXPECT_NEAR(truth.nosings.front().middle().x(), 2.0, 1e-3);
  EXPECT_NEAR(std::abs(truth.heading), 0.5 * std::pow(3 * sim::kDegree, 2), 1e-4);
  EXPECT_NEAR(truth.heading, levelled_truths(scene, scanner).front().heading, 1e-12);
}

TEST(StepHeightErrors, compare_every_rise_between_nosings_with_the_true_one) {
  sim::SceneSpec spec = flight_ahead(2.0);
  spec.stairs.front().height_offsets_m = {0, 0, 0, 0.02, 0, 0, 0, 0, 0, 0};
  const detect::Stairway truth = sim::build_scene(spec).truths.front();
  const detect::Stairway regular = sim::build_scene(flight_ahead(2.0)).truths.front();
  const std::vector<double> errors = step_height_errors(regular, truth);
  ASSERT_EQ(errors.size(), 9U);
  for (std::size_t i = 0; i < errors.size(); ++i)
    EXPECT_NEAR(errors[i], i == 2 ? -0.02 : i == 3 ? 0.02 : 0.0, 1e-9) << i;
}

TEST(AccuracyCases, have_scenes_that_can_be_built_and_are_the_same_each_time) {
  for (const AccuracyCase& of : accuracy_cases()) {
    SCOPED_TRACE(of.name);
    for (std::uint64_t seed = 1000; seed < 1010; ++seed) {
      EXPECT_EQ(of.scene(seed).problem(), "");
      EXPECT_EQ(of.scene(seed).stairs.empty(), !of.has_stairs());
      EXPECT_EQ(of.scanner(seed).problem(), "");
      EXPECT_EQ(of.scanner(seed).robot_roll_rad, of.scanner(seed).robot_roll_rad);
    }
  }
}

TEST(Accuracy, tells_what_was_found_errors_sigmas_and_steps_of_every_case) {
  Request request;
  request.seed = 1000;
  request.share = 1e-6;
  request.settings.disk.period_s = 2.0;
  const Result result = run_accuracy(request);
  ASSERT_EQ(result.tables.size(), 4U);
  EXPECT_EQ(result.tables[0].rows.size(), accuracy_cases().size());
  for (const Table& table : result.tables) {
    SCOPED_TRACE(table.name);
    for (const auto& row : table.rows) EXPECT_EQ(row.size(), table.columns.size());
  }
  EXPECT_EQ(result.charts.size(), 4U);
  EXPECT_FALSE(result.notes.empty());
}

}  // namespace
}  // namespace stairway::evaluation
