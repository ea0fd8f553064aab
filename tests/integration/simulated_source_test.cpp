// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "tools/stairwayd/simulated_source.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tools/sim/scene_file.hpp"

namespace stairway::daemon {
namespace {

using namespace std::chrono_literals;

config::Settings fast(double disk_period_s = 6.0) {
  config::Settings settings;
  settings.simulate.speed = 0.0;
  settings.disk.period_s = disk_period_s;
  return settings;
}

struct Measured {
  std::vector<drivers::LaserScan> scans;
  std::vector<drivers::AngleSample> angles;
};

Measured read_scans(SimulatedSource& source, std::size_t scans) {
  Measured measured;
  for (int reads = 0; reads < 2000 && measured.scans.size() < scans; ++reads) {
    for (SourceEvent& event : source.read(100ms)) {
      if (auto* scan = std::get_if<drivers::LaserScan>(&event)) measured.scans.push_back(std::move(*scan));
      if (auto* angles = std::get_if<std::vector<drivers::AngleSample>>(&event))
        measured.angles.insert(measured.angles.end(), angles->begin(), angles->end());
    }
  }
  return measured;
}

TEST(SimulatedSource, disk_rests_until_the_scanner_streams_and_reaches_its_index_at_full_speed) {
  for (const double period_s : {6.0, -6.0}) {
    SCOPED_TRACE(period_s);
    SimulatedSource source(fast(period_s), 0);
    const Measured measured = read_scans(source, 200);
    ASSERT_EQ(measured.scans.size(), 200u);
    const drivers::HostStamp streaming_ns = measured.scans.front().first_beam_stamp_ns;
    const double start_rad = measured.angles.front().angle_rad;
    const drivers::AngleSample* before = nullptr;
    for (const drivers::AngleSample& sample : measured.angles) {
      if (sample.stamp_ns < streaming_ns - 100'000'000) {
        EXPECT_EQ(sample.angle_rad, start_rad);
      }
      if (sample.valid) break;
      before = &sample;
    }
    ASSERT_TRUE(measured.angles.back().valid);
    ASSERT_NE(before, nullptr);
    const drivers::AngleSample& first = *(before + 1);
    const drivers::AngleSample& later = *(before + 100);
    const double speed_rad_s =
        1e9 * (later.angle_rad - first.angle_rad) / static_cast<double>(later.stamp_ns - first.stamp_ns);
    EXPECT_NEAR(speed_rad_s, 2.0 * M_PI / period_s, 0.01);
    EXPECT_NEAR(std::remainder(first.angle_rad, 2.0 * M_PI), 0.0, 0.01);
  }
}

TEST(SimulatedSource, angles_are_known_when_their_scan_comes) {
  SimulatedSource source(fast(), 0);
  drivers::HostStamp newest_ns = 0;
  int scans = 0;
  for (int reads = 0; reads < 2000 && scans < 40; ++reads) {
    for (const SourceEvent& event : source.read(100ms)) {
      if (const auto* angles = std::get_if<std::vector<drivers::AngleSample>>(&event))
        newest_ns = angles->back().stamp_ns;
      const auto* scan = std::get_if<drivers::LaserScan>(&event);
      if (scan == nullptr) continue;
      ++scans;
      EXPECT_LE(scan->first_beam_stamp_ns, newest_ns + 50'000'000) << "at rest an angle is repeated every 50 ms";
    }
  }
  EXPECT_EQ(scans, 40);
}

TEST(SimulatedSource, same_settings_measure_the_same) {
  SimulatedSource one(fast(), 0), other(fast(), 1'000);
  const Measured first = read_scans(one, 20), second = read_scans(other, 20);
  ASSERT_EQ(first.scans.size(), 20u);
  for (std::size_t i = 0; i < 20; ++i) {
    EXPECT_EQ(first.scans[i].first_beam_stamp_ns, second.scans[i].first_beam_stamp_ns);
    EXPECT_EQ(first.scans[i].statuses, second.scans[i].statuses);
  }
}

TEST(SimulatedSource, begins_at_the_given_time) {
  const SimulatedSource source(fast(), 1'700'000'000'000'000);
  EXPECT_EQ(source.utime_us(2'000'000), 1'700'000'000'002'000);
}

TEST(SimulatedSource, unknown_scene_is_refused) {
  config::Settings settings = fast();
  settings.simulate.scene = "moon";
  EXPECT_THROW(SimulatedSource(settings, 0), sim::SceneFileError);
}

}  // namespace
}  // namespace stairway::daemon
