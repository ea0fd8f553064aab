// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>

#include "tools/sim/random_scenes.hpp"
#include "tools/sim/scene_file.hpp"
#include "tools/sim/sweep.hpp"

namespace stairway::sim {
namespace {

SweepOptions short_sweep() {
  SweepOptions options;
  options.disk_period_s = 1.0;
  return options;
}

TEST(SimSweep, does_not_depend_on_the_number_of_threads) {
  const Scene scene = build_scene(random_stair_scene(1));
  SweepOptions options = short_sweep();
  options.threads = 1;
  const auto serial = simulate_ranges(scene, {}, {}, options, 5);
  options.threads = 4;
  EXPECT_EQ(simulate_ranges(scene, {}, {}, options, 5), serial);
  EXPECT_NE(simulate_ranges(scene, {}, {}, options, 6), serial);
}

TEST(SimSweep, points_lie_on_the_room_they_were_measured_in) {
  const Scene scene = build_scene(load_scene("empty-room"));
  ScannerOptions scanner;
  scanner.noise_near_m = scanner.noise_far_m = 0.0;
  for (const double period : {1.0, -1.0}) {
    SCOPED_TRACE(period);
    scan::MountOptions mount;
    mount.lever_arm_x_m = 0.1;
    mount.lever_arm_z_m = 0.05;
    SweepOptions options;
    options.disk_period_s = period;
    options.start_angle_rad = 0.7;
    const auto cloud = simulate_sweep(scene, mount, scanner, options, 1);
    ASSERT_EQ(cloud.points.size(), 40U * kBeams);
    EXPECT_NEAR((*cloud.sensor_origin - Eigen::Vector3f{0.0F, 0.0F, 0.55F}).norm(), 0.0, 1e-6);
    int off = 0;
    for (const auto& p : cloud.points) {
      const double distance = std::min({std::abs(p.x() + 4.0), std::abs(p.x() - 5.0), std::abs(p.y() + 3.0),
                                        std::abs(p.y() - 4.0), std::abs(p.z() - 0.0), std::abs(p.z() - 2.7)});
      off += distance > 0.0015;
    }
    // Where the spot lies across a corner of the room, its mean range is a little short.
    EXPECT_LT(off, static_cast<int>(cloud.points.size() / 50));
  }
}

TEST(SimSweep, sees_the_elevations_of_the_mount) {
  const Scene scene = build_scene(load_scene("empty-room"));
  const auto extremes = [&](double pitch_rad) {
    scan::MountOptions mount;
    mount.scan_plane_pitch_rad = pitch_rad;
    const auto cloud = simulate_sweep(scene, mount, {}, short_sweep(), 1);
    std::pair<double, double> result{9, -9};
    for (const auto& p : cloud.points) {
      const double elevation = std::atan2(p.z() - 0.5, std::hypot(p.x(), p.y())) * 180 / M_PI;
      result = {std::min(result.first, elevation), std::max(result.second, elevation)};
    }
    return result;
  };
  const auto upright = extremes(M_PI / 3);
  EXPECT_NEAR(upright.first, -37.8, 0.1);
  EXPECT_NEAR(upright.second, 60.0, 0.1);
  const auto inverted = extremes(-M_PI / 3);
  EXPECT_NEAR(inverted.first, -60.0, 0.1);
  EXPECT_NEAR(inverted.second, 37.8, 0.1);
}

TEST(SimSweep, refuses_a_disk_that_stands) {
  SweepOptions options;
  options.disk_period_s = 0.0;
  EXPECT_THROW(simulate_ranges(Scene{}, {}, {}, options, 1), std::invalid_argument);
}

}  // namespace
}  // namespace stairway::sim
