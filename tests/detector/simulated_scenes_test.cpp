// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "detector/stairway_detector.hpp"
#include "tests/detector/scene_fixtures.hpp"

namespace stairway::detect {
namespace {

// The detector was tuned on seeds from 1000 to 1999 and on none of these.
constexpr std::uint64_t kFirstSeed = 50000;

double place_error(const Stairway& found, const Stairway& truth) {
  return (found.met_nosing().middle() - truth.met_nosing().middle()).norm();
}

const Stairway* match(const Detection& detection, const Stairway& truth) {
  for (const Stairway& found : detection.stairways)
    if (found.kind == truth.kind && found.direction == truth.direction && place_error(found, truth) < 0.3 &&
        test::turn_between(found.heading, truth.heading) < 0.2)
      return &found;
  return nullptr;
}

/// Mean and largest size of an error.
class Errors {
 public:
  void add(double error) {
    sum_ += std::abs(error);
    largest_ = std::max(largest_, std::abs(error));
    ++count_;
  }
  double mean() const { return sum_ / count_; }
  double largest() const { return largest_; }

 private:
  double sum_ = 0.0;
  double largest_ = 0.0;
  int count_ = 0;
};

/// What was found of scenes with one stairway each; prints a line for every scene.
struct Tally {
  int scenes = 0;
  int found = 0;
  int false_ones = 0;
  int wrong_steps = 0;
  int wrong_railings = 0;
  Errors height, depth, width, heading, turn, place;

  void add(const Detection& detection, const Stairway& truth, std::uint64_t seed, const sim::StairSpec& spec) {
    ++scenes;
    const Stairway* answer = match(detection, truth);
    false_ones += static_cast<int>(detection.stairways.size()) - (answer ? 1 : 0);
    fmt::print("{:5} {:6} n {:2} h {:.3f} d {:.3f} w {:.2f} turn {:5.1f} at {:.1f} m ", seed,
               spec.open_risers ? "open" : "closed", spec.steps, spec.height_m, spec.depth_m, spec.width_m,
               spec.turn_per_step_rad * 180.0 / M_PI, spec.position.norm());
    if (!answer) {
      fmt::print("    no\n");
      return;
    }
    ++found;
    wrong_railings += answer->railing_left != truth.railing_left ? 1 : 0;
    wrong_railings += answer->railing_right != truth.railing_right ? 1 : 0;
    wrong_steps += answer->nosings.size() != truth.nosings.size() ? 1 : 0;
    const double off_height = 1e3 * (answer->step_height - truth.step_height);
    const double off_depth = 1e3 * (answer->step_depth - truth.step_depth);
    const double off_width = 1e3 * (answer->width - truth.width);
    const double off_heading = std::remainder(answer->heading - truth.heading, 2.0 * M_PI) * 180.0 / M_PI;
    const double off_turn = (answer->turn_per_step - truth.turn_per_step) * 180.0 / M_PI;
    const double off_place = 1e3 * place_error(*answer, truth);
    fmt::print("    yes {:+7.2f} {:+7.2f} {:+7.1f} {:+7.2f} {:+6.2f} {:7.1f} {:3}/{}\n", off_height, off_depth,
               off_width, off_heading, off_turn, off_place, answer->nosings.size(), truth.nosings.size());
    height.add(off_height);
    depth.add(off_depth);
    width.add(off_width);
    heading.add(off_heading);
    turn.add(off_turn);
    place.add(off_place);
  }

  void print() const {
    fmt::print("found {} of {}, false {}, another number of steps {}, wrong railings {}\n", found, scenes, false_ones,
               wrong_steps, wrong_railings);
    fmt::print(
        "mean absolute error: height {:.2f} mm, depth {:.2f} mm, width {:.1f} mm, heading {:.2f} deg, turn {:.2f} deg, "
        "place {:.1f} mm\n",
        height.mean(), depth.mean(), width.mean(), heading.mean(), turn.mean(), place.mean());
  }
};

Tally tally(sim::SceneSpec (*random_scene)(std::uint64_t), int scenes) {
  fmt::print(
      "seed  stairway                                                  found  height   depth   width heading   turn   "
      "place  "
      "steps\n");
  Tally result;
  for (int i = 0; i < scenes; ++i) {
    const std::uint64_t seed = kFirstSeed + static_cast<std::uint64_t>(i);
    const sim::SceneSpec spec = random_scene(seed);
    const sim::Scene scene = sim::build_scene(spec);
    const scan::PointCloud cloud = sim::simulate_sweep(scene, scene.mount.value_or(scan::MountOptions{}), {}, {}, seed);
    result.add(detect_stairways(cloud), scene.truths.front(), seed, spec.stairs.front());
  }
  if (result.found > 0) result.print();
  return result;
}

TEST(SimulatedFlights, are_all_found_to_a_few_millimetres) {
  const Tally flights = tally(sim::random_stair_scene, 30);
  ASSERT_EQ(flights.found, 30);
  EXPECT_EQ(flights.false_ones, 0);
  EXPECT_LE(flights.wrong_railings, 3) << "of 60 sides";
  EXPECT_LT(flights.height.mean(), 2.5) << "mm, as the paper reaches in a hall";
  EXPECT_LT(flights.depth.mean(), 2.5) << "mm";
}

// The paper's Fig. 11: a wall that stands before the right side hides it and its railing.
TEST(SimulatedFlights, hidden_on_the_right_are_anchored_at_the_railing_on_the_left) {
  constexpr double kDistance_m = 2.2;
  constexpr double kWall_m = 2.0;
  for (const double hidden_m : {0.5, 0.6}) {
    SCOPED_TRACE(hidden_m);
    sim::StairSpec flight;
    flight.railing_left = flight.railing_right = true;
    flight.position = {kDistance_m, 0.0};
    const double wall_x = 0.6 * kDistance_m;
    const double wall_end = (hidden_m - 0.5 * flight.width_m) * wall_x / kDistance_m;
    sim::SceneSpec spec;
    spec.room = {.low = {-4.0, -6.0}, .high = {11.0, 6.0}};
    spec.stairs = {flight};
    spec.furniture = {{.kind = sim::FurnitureKind::Wall,
                       .position = {wall_x, wall_end - 0.5 * kWall_m},
                       .yaw_rad = M_PI / 2,
                       .size = {kWall_m, 0.12, 2.8}}};
    const sim::Scene scene = sim::build_scene(spec);
    const Detection detection = detect_stairways(sim::simulate_sweep(scene, {}, {}, {}, kFirstSeed));
    ASSERT_EQ(detection.stairways.size(), 1U);
    const Stairway& found = detection.stairways[0];
    EXPECT_EQ(found.anchor_side, AnchorSide::Left);
    EXPECT_LT((found.anchor - scene.truths[0].nosings[0].left).norm(), 0.03);
  }
}

TEST(SimulatedSpirals, are_found_with_their_turn) {
  const Tally spirals = tally(sim::random_spiral_scene, 20);
  ASSERT_GE(spirals.found, 18);
  EXPECT_LE(spirals.false_ones, 1) << "the far side of a spiral may look like a flight of its own";
  EXPECT_LT(spirals.height.largest(), 5.0) << "mm";
  EXPECT_LT(spirals.turn.largest(), 1.0) << "degrees a step";
}

TEST(SimulatedDescents, are_found_from_their_edge) {
  const Tally descents = tally(sim::random_descending_scene, 20);
  ASSERT_GE(descents.found, 18);
  EXPECT_EQ(descents.false_ones, 0);
  EXPECT_LT(descents.height.largest(), 5.0) << "mm";
}

TEST(SimulatedLandings, show_the_flight_up_and_the_flight_down) {
  for (std::uint64_t seed = kFirstSeed; seed < kFirstSeed + 5; ++seed) {
    SCOPED_TRACE(seed);
    const sim::Scene scene = sim::build_scene(sim::random_mid_landing_scene(seed));
    const Detection detection = detect_stairways(sim::simulate_sweep(scene, *scene.mount, {}, {}, seed));
    EXPECT_EQ(detection.stairways.size(), 2U);
    for (const Stairway& truth : scene.truths) EXPECT_TRUE(match(detection, truth));
  }
}

TEST(SimulatedRooms, have_no_stairs_where_there_are_none) {
  constexpr std::uint64_t kRooms = 50;
  for (std::uint64_t seed = kFirstSeed; seed < kFirstSeed + kRooms; ++seed) {
    SCOPED_TRACE(seed);
    const Detection detection = detect_stairways(test::simulate_room(seed, sim::kUsualDiskPeriod_s));
    EXPECT_TRUE(detection.stairways.empty());
    EXPECT_FALSE(detection.rejected.empty()) << "silence needs a reason";
  }
}

}  // namespace
}  // namespace stairway::detect
