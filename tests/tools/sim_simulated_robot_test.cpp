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

#include "drivers/disk_encoder.hpp"
#include "drivers/disk_motor.hpp"
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

// As if by hand; the drive is not on.
void turn_disk(SimulatedRobot& robot, double speed_rad_s) {
  robot.tamper([&](const SimulatedRobot::Parts& parts) { parts.disk.set_speed(parts.now_ns, speed_rad_s); });
}

drivers::Utm30lx open_driver(SimulatedRobot& robot) {
  return {robot.scanner(), [&] { return robot.now_ns(); }, {}};
}

drivers::DiskEncoder open_encoder(SimulatedRobot& robot) {
  return {robot.encoder(), [&] { return robot.now_ns(); }, {}};
}

template <class Port>
std::unique_ptr<Port> open_port(const drivers::PortOpener<Port>& opener) {
  auto port = opener.open();
  return port ? std::move(*port) : nullptr;
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
  SimulatedRobot robot{empty_room(), {}};
  turn_disk(robot, 2 * std::numbers::pi / 2.0);
  std::mutex mutex;
  scan::SweepAssembler assembler{scan::make_calibration({})};
  std::atomic<bool> is_done{false};
  std::jthread reader{[&] {
    auto encoder = open_encoder(robot);
    while (!is_done) {
      for (auto& event : encoder.poll(20ms)) {
        const std::lock_guard lock{mutex};
        if (const auto* samples = std::get_if<std::vector<drivers::AngleSample>>(&event)) assembler.add(*samples);
      }
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

TEST(SimRobot, drive_turns_the_disk_and_one_thread_may_read_all_ports) {
  SimulatedRobotOptions options;
  options.start_angle_rad = -0.2;
  SimulatedRobot robot{empty_room(), options};
  auto scanner = open_driver(robot);
  auto encoder = open_encoder(robot);
  drivers::DiskMotor motor{robot.motor(), [&] { return robot.now_ns(); }, {}};
  motor.set_speed(0.5);
  drivers::AngleSample last;
  double drive_rad_s = 0.0;
  std::size_t scans = 0;
  while (robot.now_ns() < 5'000'000'000) {
    for (const auto& event : scanner.poll(50ms)) scans += std::holds_alternative<drivers::LaserScan>(event);
    for (const auto& event : motor.poll(0ms)) {
      if (const auto* feedback = std::get_if<drivers::DriveFeedback>(&event)) drive_rad_s = feedback->speed_rad_s;
    }
    for (const auto& event : encoder.poll(0ms)) {
      if (const auto* samples = std::get_if<std::vector<drivers::AngleSample>>(&event)) last = samples->back();
    }
  }
  EXPECT_GT(scans, 50u);
  EXPECT_NEAR(drive_rad_s, 0.5, 1e-3);
  EXPECT_NEAR(robot.disk_speed_rad_s(), 0.5, 1e-3);
  EXPECT_TRUE(last.valid);
  EXPECT_NEAR(last.angle_rad, robot.disk_angle_rad(), 0.06);
  EXPECT_TRUE(motor.stop());
  EXPECT_EQ(robot.disk_speed_rad_s(), 0.0);
}

TEST(SimRobot, pulled_cable_closes_the_port_until_it_is_plugged_in_again) {
  for (const auto cable :
       {SimulatedRobot::Cable::Scanner, SimulatedRobot::Cable::Motor, SimulatedRobot::Cable::Encoder}) {
    SimulatedRobotOptions options;
    options.speed_factor = 10.0;
    SimulatedRobot robot{empty_room(), options};
    auto scanner = open_port(robot.scanner());
    auto motor = open_port(robot.motor());
    auto encoder = open_port(robot.encoder());
    ASSERT_TRUE(scanner && motor && encoder);
    robot.plug(cable, false);
    EXPECT_EQ(scanner->read(1ms).has_value(), cable != SimulatedRobot::Cable::Scanner);
    EXPECT_EQ(motor->read(1ms).has_value(), cable != SimulatedRobot::Cable::Motor);
    EXPECT_EQ(encoder->read(1ms).has_value(), cable != SimulatedRobot::Cable::Encoder);
    EXPECT_EQ(open_port(robot.scanner()) != nullptr, cable != SimulatedRobot::Cable::Scanner);
    robot.plug(cable, true);
    EXPECT_TRUE(robot.scanner().open().has_value());
    EXPECT_TRUE(robot.motor().open().has_value());
    EXPECT_TRUE(robot.encoder().open().has_value());
  }
}

TEST(SimRobot, without_commands_time_passes_with_the_waits) {
  SimulatedRobot robot{empty_room(), {}};
  auto scanner = open_port(robot.scanner());
  const auto chunk = scanner->read(10s);
  ASSERT_TRUE(chunk);
  EXPECT_TRUE(chunk->bytes.empty());
  EXPECT_EQ(chunk->arrival_ns, 10'000'000'000);
}

TEST(SimRobot, the_encoder_alone_moves_time_and_follows_the_disk) {
  SimulatedRobot robot{empty_room(), {}};
  auto encoder = open_encoder(robot);
  turn_disk(robot, -1.0);
  double angle = 0;
  while (robot.now_ns() < 2'000'000'000) {
    for (const auto& event : encoder.poll(100ms)) {
      if (const auto* samples = std::get_if<std::vector<drivers::AngleSample>>(&event))
        angle = samples->back().angle_rad;
    }
  }
  EXPECT_NEAR(angle, -2.0, 0.06);
  EXPECT_NEAR(robot.disk_angle_rad(), -2.0, 0.06);
  EXPECT_EQ(robot.disk_speed_rad_s(), -1.0);
}

TEST(SimRobot, paced_time_follows_the_clock_of_the_machine) {
  SimulatedRobotOptions options;
  options.speed_factor = 10.0;
  SimulatedRobot robot{empty_room(), options};
  auto scanner = open_port(robot.scanner());
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
    scanner = open_port(robot.scanner());
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
