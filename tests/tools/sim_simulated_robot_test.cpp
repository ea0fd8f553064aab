// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <mutex>
#include <numbers>
#include <optional>
#include <thread>
#include <variant>

#include "drivers/utm30lx.hpp"
#include "scan_assembly/sweep_assembler.hpp"
#include "tools/sim/scene_file.hpp"
#include "tools/sim/simulated_robot.hpp"
#include "tools/sim/sweep.hpp"

namespace stairway::sim {
namespace {

using namespace std::chrono_literals;
using drivers::HostStamp;

Scene empty_room() { return build_scene(load_scene("empty-room")); }

SimulatedRobotOptions fast_disk() {
  SimulatedRobotOptions options;
  options.disk_speed_rad_s = 2 * std::numbers::pi / 2.0;
  return options;
}

drivers::Utm30lx open_driver(SimulatedRobot& robot) {
  return {{[&] { return robot.open_scanner(); }}, [&] { return robot.now_ns(); }, {}};
}

TEST(SimRobot, the_driver_opens_it_and_gets_every_scan_at_its_time) {
  SimulatedRobot robot{empty_room(), {}};
  auto driver = open_driver(robot);
  std::vector<drivers::LaserScan> scans;
  for (int i = 0; i < 2000 && scans.size() < 60; ++i) {
    for (auto& event : driver.poll(50ms)) {
      if (auto* scan = std::get_if<drivers::LaserScan>(&event)) scans.push_back(std::move(*scan));
    }
  }
  ASSERT_EQ(scans.size(), 60U);
  for (std::size_t i = 40; i < scans.size(); ++i) {
    EXPECT_EQ(scans[i].sequence, scans[i - 1].sequence + 1);
    EXPECT_EQ(scans[i].ranges_m.size(), static_cast<std::size_t>(kBeams));
    // The first beam comes 180 steps after the rear, where mirror turns begin: at whole multiples of 25 ms.
    const double rear_ns = static_cast<double>(scans[i].first_beam_stamp_ns) - 180.0 / 1440 * 25e6;
    EXPECT_NEAR(std::remainder(rear_ns, 25e6), 0.0, 0.3e6);
  }
}

TEST(SimRobot, scanner_and_encoder_read_by_two_threads_make_the_room_again) {
  SimulatedRobot robot{empty_room(), fast_disk()};
  std::mutex mutex;
  scan::SweepAssembler assembler{scan::make_calibration({})};
  std::atomic<bool> is_done{false};
  auto encoder_port = robot.open_encoder();
  std::jthread encoder{[&] {
    while (!is_done) {
      const auto samples = encoder_port->read(20ms);
      const std::lock_guard lock{mutex};
      if (samples) assembler.add(*samples);
    }
  }};
  auto driver = open_driver(robot);
  std::optional<scan::Sweep> sweep;
  for (int i = 0; i < 5000 && !sweep; ++i) {
    for (auto& event : driver.poll(20ms)) {
      const std::lock_guard lock{mutex};
      if (auto* scan = std::get_if<drivers::LaserScan>(&event)) assembler.add(std::move(*scan));
      while (auto next = assembler.take_sweep()) {
        if (next->statistics.is_whole_turn) sweep = std::move(next);
      }
    }
  }
  is_done = true;
  ASSERT_TRUE(sweep);
  EXPECT_EQ(sweep->statistics.lost_scans, 0U);
  EXPECT_GT(sweep->cloud.points.size(), 75U * kBeams);
  int off = 0;
  for (const auto& p : sweep->cloud.points) {
    const double distance = std::min({std::abs(p.x() + 4.0), std::abs(p.x() - 5.0), std::abs(p.y() + 3.0),
                                      std::abs(p.y() - 4.0), std::abs(p.z() - 0.0), std::abs(p.z() - 2.7)});
    off += distance > 0.04;
  }
  EXPECT_LT(off, static_cast<int>(sweep->cloud.points.size() / 100));
}

TEST(SimRobot, one_thread_may_read_both_ports_by_turns) {
  SimulatedRobot robot{empty_room(), fast_disk()};
  auto scanner = robot.open_scanner();
  auto encoder = robot.open_encoder();
  ASSERT_TRUE(scanner->write("MD0000108001000\n"));
  int messages = 0;
  HostStamp newest_sample_ns = 0;
  for (int i = 0; i < 400 && messages < 40; ++i) {
    const auto chunk = scanner->read(5ms);
    ASSERT_TRUE(chunk);
    messages += !chunk->bytes.empty();
    EXPECT_LE(chunk->arrival_ns, newest_sample_ns + 110'000'000);
    const auto samples = encoder->read(5ms);
    ASSERT_TRUE(samples);
    if (!samples->empty()) newest_sample_ns = samples->back().stamp_ns;
  }
  EXPECT_EQ(messages, 40);
}

TEST(SimRobot, without_commands_time_passes_with_the_waits) {
  SimulatedRobot robot{empty_room(), {}};
  auto scanner = robot.open_scanner();
  const auto chunk = scanner->read(10s);
  ASSERT_TRUE(chunk);
  EXPECT_TRUE(chunk->bytes.empty());
  EXPECT_EQ(chunk->arrival_ns, 10'000'000'000);
}

TEST(SimRobot, the_encoder_alone_moves_time_and_follows_the_disk) {
  SimulatedRobot robot{empty_room(), {}};
  auto encoder = robot.open_encoder();
  robot.set_disk_speed(-1.0);
  double angle = 0;
  while (robot.now_ns() < 2'000'000'000) {
    const auto samples = encoder->read(100ms);
    ASSERT_TRUE(samples);
    if (!samples->empty()) angle = samples->back().angle_rad;
  }
  EXPECT_NEAR(angle, -2.0, 0.01);
  EXPECT_NEAR(robot.disk_angle_rad(), -2.0, 0.01);
  EXPECT_EQ(robot.disk_speed_rad_s(), -1.0);
}

TEST(SimRobot, paced_time_follows_the_clock_of_the_machine) {
  SimulatedRobotOptions options;
  options.speed_factor = 10.0;
  SimulatedRobot robot{empty_room(), options};
  auto scanner = robot.open_scanner();
  ASSERT_TRUE(scanner->write("MD0000000001000\n"));
  const auto start = std::chrono::steady_clock::now();
  HostStamp newest_ns = 0;
  for (int messages = 0; messages < 21;) {
    const auto chunk = scanner->read(1s);
    ASSERT_TRUE(chunk);
    if (chunk->bytes.empty()) continue;
    EXPECT_GT(chunk->arrival_ns, newest_ns);
    newest_ns = chunk->arrival_ns;
    ++messages;
  }
  EXPECT_GE(std::chrono::steady_clock::now() - start, 48ms);
}

TEST(SimRobot, ports_may_outlive_the_robot) {
  std::unique_ptr<drivers::BytePort> scanner;
  {
    SimulatedRobot robot{empty_room(), {}};
    scanner = robot.open_scanner();
  }
  ASSERT_TRUE(scanner->write("BM\n"));
  EXPECT_EQ(scanner->read(1s)->bytes, "BM\n00P\n\n");
}

TEST(SimRobot, refuses_impossible_options) {
  SimulatedRobotOptions options;
  options.encoder_counts_per_turn = 0;
  EXPECT_THROW((SimulatedRobot{empty_room(), options}), std::invalid_argument);
}

}  // namespace
}  // namespace stairway::sim
