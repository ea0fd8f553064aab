// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "tools/evaluation/accuracy_cases.hpp"

#include "tools/sim/angles.hpp"
#include "tools/sim/random.hpp"
#include "tools/sim/random_flight.hpp"
#include "tools/sim/random_layout.hpp"
#include "tools/sim/random_scenes.hpp"

namespace stairway::evaluation {
namespace {

using sim::kDegree;

constexpr std::uint64_t kSceneStream = 9;
constexpr std::uint64_t kScannerStream = 10;
constexpr double kFastPeriod_s = 5.0;

struct Look {
  bool open_risers = false;
  double nearest_m = 0.5;
  double farthest_m = 6.5;
  double irregularity_m = 0.0;  ///< standard deviation of the height of a nosing
};

sim::SceneSpec flight_in_room(std::uint64_t seed, const Look& look) {
  sim::Random random{seed, kSceneStream};
  sim::StairSpec flight;
  flight.steps = random.integer(5, 12);
  sim::draw_usual_steps(flight, random);
  flight.width_m = random.uniform(0.8, 1.6);
  flight.open_risers = look.open_risers;
  sim::draw_fittings(flight, random);
  sim::place_before_robot(flight, look.nearest_m, look.farthest_m, random);
  if (look.irregularity_m > 0.0)
    for (int i = 0; i < flight.steps; ++i) flight.height_offsets_m.push_back(look.irregularity_m * random.normal());
  sim::SceneSpec spec;
  spec.name = "accuracy";
  spec.stairs = {flight};
  sim::surround(spec, random);
  return spec;
}

sim::SceneSpec closed(std::uint64_t seed) { return flight_in_room(seed, {}); }
sim::SceneSpec near(std::uint64_t seed) { return flight_in_room(seed, {.farthest_m = 4.0}); }
sim::SceneSpec open(std::uint64_t seed) { return flight_in_room(seed, {.open_risers = true, .farthest_m = 4.5}); }
sim::SceneSpec far_open(std::uint64_t seed) {
  return flight_in_room(seed, {.open_risers = true, .nearest_m = 4.5, .farthest_m = 6.0});
}
sim::SceneSpec irregular(std::uint64_t seed) {
  return flight_in_room(seed, {.nearest_m = 2.5, .farthest_m = 3.5, .irregularity_m = 0.012});
}

sim::ScannerOptions usual_scanner(std::uint64_t) { return {}; }

sim::ScannerOptions tilted_scanner(std::uint64_t seed) {
  sim::Random random{seed, kScannerStream};
  sim::ScannerOptions scanner;
  scanner.robot_roll_rad = random.uniform(-3 * kDegree, 3 * kDegree);
  scanner.robot_pitch_rad = random.uniform(-3 * kDegree, 3 * kDegree);
  return scanner;
}

sim::ScannerOptions biased_scanner(std::uint64_t) {
  sim::ScannerOptions scanner;
  scanner.range_bias_m = 0.010;
  return scanner;
}

constexpr AccuracyTargets kClosedTargets{.height_mm = 0.2,
                                         .depth_mm = 0.15,
                                         .heading_deg = 0.05,
                                         .width_mm = 5.0,
                                         .along_mm = 2.0,
                                         .across_mm = 4.0,
                                         .found_percent = 100.0};
constexpr AccuracyTargets kOpenTargets{.height_mm = 0.4,
                                       .depth_mm = 1.0,
                                       .heading_deg = 0.15,
                                       .width_mm = 8.0,
                                       .along_mm = 4.0,
                                       .across_mm = 5.0,
                                       .found_percent = 95.0};
constexpr AccuracyTargets kFarOpenTargets{.found_percent = 80.0};
constexpr AccuracyTargets kTiltedTargets{
    .height_mm = 0.4, .depth_mm = 0.3, .heading_deg = 0.1, .width_mm = 8.0, .found_percent = 100.0};
constexpr AccuracyTargets kDescendingTargets{
    .height_mm = 0.4, .depth_mm = 0.8, .heading_deg = 0.2, .width_mm = 15.0, .found_percent = 95.0};
constexpr AccuracyTargets kBiasedTargets{.height_mm = 1.0,
                                         .depth_mm = 0.3,
                                         .heading_deg = 0.1,
                                         .width_mm = 10.0,
                                         .along_mm = 12.0,
                                         .across_mm = 5.0,
                                         .found_percent = 100.0};
constexpr AccuracyTargets kFastTargets{
    .height_mm = 0.6, .depth_mm = 0.6, .heading_deg = 0.2, .width_mm = 15.0, .found_percent = 95.0};
constexpr AccuracyTargets kSpiralTargets{
    .height_mm = 1.0, .depth_mm = 3.0, .turn_deg = 0.3, .width_mm = 20.0, .found_percent = 95.0};
constexpr AccuracyTargets kIrregularTargets{.step_height_mm = 1.5, .found_percent = 95.0};

constexpr AccuracyCase kCases[]{
    {"closed", closed, usual_scanner, 0.0, kClosedTargets},
    {"open", open, usual_scanner, 0.0, kOpenTargets},
    {"open-far", far_open, usual_scanner, 0.0, kFarOpenTargets},
    {"tilted", closed, tilted_scanner, 0.0, kTiltedTargets},
    {"descending", sim::random_inverted_descending_scene, usual_scanner, 0.0, kDescendingTargets},
    {"biased", closed, biased_scanner, 0.0, kBiasedTargets},
    {"fast", near, usual_scanner, kFastPeriod_s, kFastTargets},
    {"spiral", sim::random_spiral_scene, usual_scanner, 0.0, kSpiralTargets},
    {"irregular", irregular, usual_scanner, 0.0, kIrregularTargets},
    {"rooms", sim::random_room, usual_scanner, 0.0, {}},
};

}  // namespace

std::span<const AccuracyCase> accuracy_cases() { return kCases; }

}  // namespace stairway::evaluation
