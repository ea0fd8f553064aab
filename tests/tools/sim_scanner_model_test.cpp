// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "tools/sim/scanner_model.hpp"

namespace stairway::sim {
namespace {

using Eigen::Vector3d;

// A scan plane that lies level half a metre above the floor, so that beams are easy to reckon.
scan::Calibration level_mount() {
  scan::MountOptions mount;
  mount.scan_plane_pitch_rad = 0.0;
  return scan::make_calibration(mount);
}

// A wall across x at the given distance, from y_low to y_high.
void add_wall(Mesh& mesh, double x, double y_low, double y_high) {
  mesh.add_polygon(
      std::array{Vector3d{x, y_low, 0}, Vector3d{x, y_high, 0}, Vector3d{x, y_high, 3}, Vector3d{x, y_low, 3}});
}

std::vector<std::uint32_t> measure(const Mesh& mesh, const ScannerOptions& options, std::uint64_t stream = 0,
                                   std::uint64_t seed = 1) {
  std::vector<std::uint32_t> values(kBeams);
  ScannerModel{mesh, level_mount(), options, seed}.measure_turn(stream, 0.0, 0.0, values);
  return values;
}

ScannerOptions without_noise() {
  ScannerOptions options;
  options.noise_near_m = options.noise_far_m = 0.0;
  return options;
}

double beam_angle(std::size_t beam) { return 0.25 * M_PI / 180 * (static_cast<double>(beam) - kFrontBeam); }

TEST(SimScanner, measures_a_wall_at_its_range_in_every_direction) {
  Mesh mesh;
  add_wall(mesh, 4.0, -20, 20);
  const auto values = measure(mesh, without_noise());
  for (std::size_t beam = 300; beam <= 780; ++beam) {
    EXPECT_NEAR(values[beam], 4000.0 / std::cos(beam_angle(beam)), 0.6) << beam;
  }
  EXPECT_EQ(values[0], 1U);
}

TEST(SimScanner, codes_what_is_too_far_and_too_near) {
  Mesh far;
  add_wall(far, 30.2, -20, 20);
  EXPECT_EQ(measure(far, without_noise())[kFrontBeam], 1U);
  Mesh near;
  add_wall(near, 0.09, -20, 20);
  EXPECT_EQ(measure(near, without_noise())[kFrontBeam], 2U);
}

struct Moments {
  double mean, sigma;
};

Moments moments_at(double distance, const ScannerOptions& options) {
  Mesh mesh;
  add_wall(mesh, distance, -20, 20);
  const ScannerModel model{mesh, level_mount(), options, 1};
  std::vector<std::uint32_t> values(kBeams);
  double sum = 0;
  double squares = 0;
  int count = 0;
  for (std::uint64_t turn = 0; turn < 100; ++turn) {
    model.measure_turn(turn, 0.0, 0.0, values);
    for (std::size_t beam = kFrontBeam - 50; beam <= kFrontBeam + 50; ++beam) {
      const double error = 0.001 * values[beam] - distance / std::cos(beam_angle(beam));
      sum += error;
      squares += error * error;
      ++count;
    }
  }
  const double mean = sum / count;
  return {mean, std::sqrt(squares / count - mean * mean)};
}

TEST(SimScanner, noise_has_the_specified_spread_and_bias) {
  EXPECT_NEAR(moments_at(4.0, {}).sigma, 0.010, 0.0003);
  EXPECT_NEAR(moments_at(4.0, {}).mean, 0.0, 0.0004);
  EXPECT_NEAR(moments_at(15.0, {}).sigma, 0.030, 0.0009);
  ScannerOptions biased;
  biased.range_bias_m = 0.02;
  EXPECT_NEAR(moments_at(4.0, biased).mean, 0.02, 0.0004);
}

TEST(SimScanner, drops_the_given_share_of_beams) {
  Mesh mesh;
  add_wall(mesh, 2.0, -100, 100);
  ScannerOptions options;
  options.dropout_share = 0.3;
  int dropped = 0;
  constexpr int kTurns = 40;
  for (std::uint64_t turn = 0; turn < kTurns; ++turn) {
    const auto values = measure(mesh, options, turn);
    for (std::size_t beam = 440; beam < 640; ++beam) dropped += values[beam] == 1U;
  }
  EXPECT_NEAR(dropped / (200.0 * kTurns), 0.3, 0.02);
}

// A near wall left of the front beam and a far one behind it: ranges between the two may only appear where the spot
// lies on the edge.
std::vector<std::size_t> beams_between(double near_m, double far_m) {
  Mesh mesh;
  add_wall(mesh, near_m, 0.0, 20.0);
  add_wall(mesh, far_m, -20.0, 20.0);
  const auto values = measure(mesh, without_noise());
  std::vector<std::size_t> between;
  for (std::size_t beam = 400; beam <= 680; ++beam) {
    const double slant = std::cos(beam_angle(beam));
    if (values[beam] * slant > 1000 * near_m + 5 && values[beam] * slant < 1000 * far_m - 5) between.push_back(beam);
  }
  return between;
}

TEST(SimScanner, mixes_pixels_at_edges_of_near_surfaces_and_nowhere_else) {
  const auto mixed = beams_between(3.0, 3.4);
  ASSERT_FALSE(mixed.empty());
  for (const std::size_t beam : mixed) EXPECT_LE(std::abs(beam_angle(beam)), 13.3e-3 / 2) << beam;
  EXPECT_GE(mixed.size(), 2U);
}

TEST(SimScanner, lets_the_larger_share_win_when_surfaces_are_far_apart) {
  EXPECT_TRUE(beams_between(3.0, 5.0).empty());
}

TEST(SimScanner, a_narrow_post_before_a_far_wall_is_seen_when_it_fills_half_the_spot) {
  const auto front_range = [](double width) {
    Mesh mesh;
    add_wall(mesh, 3.0, -width / 2, width / 2);
    add_wall(mesh, 6.0, -20.0, 20.0);
    return measure(mesh, without_noise())[kFrontBeam];
  };
  EXPECT_NEAR(front_range(0.03), 3000, 2);  // of a spot of 40 mm
  EXPECT_NEAR(front_range(0.008), 6000, 2);
}

TEST(SimScanner, a_tilted_robot_sees_the_floor_in_front_of_its_nose) {
  Mesh mesh;
  mesh.add_horizontal(rectangle({0, 0}, {50, 50}, 0), 0.0);
  ScannerOptions options = without_noise();
  EXPECT_EQ(measure(mesh, options)[kFrontBeam], 1U);
  options.robot_pitch_rad = 0.1;
  EXPECT_NEAR(measure(mesh, options)[kFrontBeam], 1000 * 0.5 / std::tan(0.1), 8);
}

TEST(SimScanner, repeats_itself_by_seed_and_stream) {
  Mesh mesh;
  add_wall(mesh, 4.0, -20, 20);
  EXPECT_EQ(measure(mesh, {}, 3, 9), measure(mesh, {}, 3, 9));
  EXPECT_NE(measure(mesh, {}, 3, 9), measure(mesh, {}, 4, 9));
  EXPECT_NE(measure(mesh, {}, 3, 9), measure(mesh, {}, 3, 8));
}

TEST(SimScanner, refuses_impossible_options) {
  ScannerOptions options;
  options.dropout_share = 1.5;
  EXPECT_NE(options.problem(), "");
  EXPECT_THROW(measure(Mesh{}, options), std::invalid_argument);
}

}  // namespace
}  // namespace stairway::sim
