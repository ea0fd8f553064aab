// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "detector/stairway_detector.hpp"
#include "tests/detector/scene_fixtures.hpp"

namespace stairway::detect {
namespace {

// The detector was tuned on seeds from 1000 to 1999 and on none of these.
constexpr std::uint64_t kFirstSeed = 50000;
constexpr int kFlights = 30;
constexpr int kRooms = 10;

const Stairway* match(const Detection& detection, const Stairway& truth) {
  for (const Stairway& found : detection.stairways)
    if ((test::middle(found.nosings[0]) - test::middle(truth.nosings[0])).norm() < 0.3 &&
        test::turn_between(found.heading, truth.heading) < 0.2)
      return &found;
  return nullptr;
}

TEST(SimulatedFlights, are_all_found_to_a_few_millimetres) {
  double height = 0.0, depth = 0.0, width = 0.0, heading = 0.0, place = 0.0;
  int found_count = 0, false_count = 0, wrong_steps = 0;
  fmt::print("seed  flight                                     found  height   depth   width heading   place  steps\n");
  for (int i = 0; i < kFlights; ++i) {
    const std::uint64_t seed = kFirstSeed + static_cast<std::uint64_t>(i);
    const sim::SceneSpec spec = sim::random_stair_scene(seed);
    const sim::Scene scene = sim::build_scene(spec);
    const Stairway& truth = scene.truths.front();
    const Detection detection = detect_stairways(sim::simulate_sweep(scene, {}, {}, {}, seed));
    const Stairway* found = match(detection, truth);
    false_count += static_cast<int>(detection.stairways.size()) - (found ? 1 : 0);
    const sim::StairSpec& flight = spec.stairs.front();
    fmt::print("{:5} {:6} n {:2} h {:.3f} d {:.3f} w {:.2f} at {:.1f} m ", seed, flight.open_risers ? "open" : "closed",
               flight.steps, flight.height_m, flight.depth_m, flight.width_m, flight.position.norm());
    if (!found) {
      fmt::print("    no\n");
      continue;
    }
    ++found_count;
    wrong_steps += found->nosings.size() != truth.nosings.size() ? 1 : 0;
    const double off_height = found->step_height - truth.step_height;
    const double off_depth = found->step_depth - truth.step_depth;
    const double off_width = found->width - truth.width;
    const double off_heading = std::remainder(found->heading - truth.heading, 2.0 * M_PI) * 180.0 / M_PI;
    const double off_place = (test::middle(found->nosings[0]) - test::middle(truth.nosings[0])).norm();
    fmt::print("    yes {:+7.2f} {:+7.2f} {:+7.1f} {:+7.2f} {:7.1f} {:3}/{}\n", 1e3 * off_height, 1e3 * off_depth,
               1e3 * off_width, off_heading, 1e3 * off_place, found->nosings.size(), truth.nosings.size());
    height += std::abs(off_height);
    depth += std::abs(off_depth);
    width += std::abs(off_width);
    heading += std::abs(off_heading);
    place += off_place;
  }
  ASSERT_GT(found_count, 0);
  const double n = found_count;
  fmt::print("found {} of {}, false {}, wrong number of steps {}\n", found_count, kFlights, false_count, wrong_steps);
  fmt::print(
      "mean absolute error: height {:.2f} mm, depth {:.2f} mm, width {:.1f} mm, heading {:.2f} deg, place {:.1f} mm\n",
      1e3 * height / n, 1e3 * depth / n, 1e3 * width / n, heading / n, 1e3 * place / n);
  EXPECT_EQ(found_count, kFlights);
  EXPECT_EQ(false_count, 0);
  EXPECT_LT(height / n, 0.003);
  EXPECT_LT(depth / n, 0.003);
}

TEST(SimulatedFlights, are_not_seen_in_rooms_without_stairs) {
  for (int i = 0; i < kRooms; ++i) {
    const std::uint64_t seed = kFirstSeed + static_cast<std::uint64_t>(i);
    SCOPED_TRACE(seed);
    const Detection detection = detect_stairways(test::simulate_room(seed, sim::kUsualDiskPeriod_s));
    EXPECT_TRUE(detection.stairways.empty());
    EXPECT_FALSE(detection.rejected.empty()) << "silence needs a reason";
  }
}

}  // namespace
}  // namespace stairway::detect
