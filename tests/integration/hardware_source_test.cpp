// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "tools/stairwayd/hardware_source.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <cmath>
#include <map>
#include <string>
#include <thread>

#include "tools/sim/scene_file.hpp"
#include "tools/stairwayd/simulated_source.hpp"

namespace stairway::daemon {
namespace {

using namespace std::chrono_literals;
using Cable = sim::SimulatedRobot::Cable;

config::Settings settings_for_threads() {
  config::Settings settings;
  settings.simulate.speed = 1.0;
  settings.disk.check_window_s = 0.3;
  settings.disk.settle_s = 0.1;
  settings.lidar.min_angle_rad = -0.1;
  settings.lidar.max_angle_rad = 0.1;
  settings.lidar.cluster = 10;
  return settings;
}

DevicePorts ports(sim::SimulatedRobot& robot) {
  return {robot.scanner(), robot.motor(), robot.encoder(), std::nullopt, [&robot] { return robot.now_ns(); }};
}

class HardwareSourceTest : public testing::Test {
 protected:
  template <class Condition>
  bool reads_until(HardwareSource& source, Condition condition) {
    const auto end = std::chrono::steady_clock::now() + 60s;
    while (!condition() && std::chrono::steady_clock::now() < end) {
      for (const SourceEvent& event : source.read(100ms)) note(event);
    }
    return condition();
  }
  void note(const SourceEvent& event) {
    if (const auto* state = std::get_if<SourceState>(&event)) states[state->device] = *state;
    if (const auto* angles = std::get_if<std::vector<drivers::AngleSample>>(&event)) {
      for (const drivers::AngleSample& sample : *angles) {
        EXPECT_GT(sample.stamp_ns, last_angle_ns);
        last_angle_ns = sample.stamp_ns;
      }
    }
    if (const auto* trouble = std::get_if<SourceTrouble>(&event)) ++troubles[trouble->name];
    scans += std::holds_alternative<drivers::LaserScan>(event);
    clocks += std::holds_alternative<drivers::ClockQuality>(event);
  }
  bool is_good(Device device) { return states[device].condition == Condition::Good; }
  bool is_turning() { return robot.disk_speed_rad_s() > 0.9 * settings.disk.speed_rad_s(); }

  const config::Settings settings = settings_for_threads();
  sim::SimulatedRobot robot{sim::build_scene(sim::load_scene("empty-room")), simulated_robot_options(settings)};
  std::map<Device, SourceState> states;
  std::map<std::string, int> troubles;
  drivers::HostStamp last_angle_ns = -1;
  int scans = 0, clocks = 0;
};

TEST_F(HardwareSourceTest, threads_bring_the_devices_up_lose_one_and_get_it_back) {
  HardwareSource source(settings, ports(robot), [](drivers::HostStamp stamp_ns) { return stamp_ns / 1000; });
  ASSERT_TRUE(reads_until(source, [&] {
    return is_turning() && scans > 20 && clocks > 0 && last_angle_ns > 0 && is_good(Device::Scanner) &&
           is_good(Device::Motor);
  }));
  EXPECT_EQ(source.utime_us(5'000), 5);

  robot.plug(Cable::Scanner, false);
  ASSERT_TRUE(reads_until(source, [&] { return states[Device::Scanner].condition == Condition::Failed; }));
  robot.plug(Cable::Scanner, true);
  scans = 0;
  ASSERT_TRUE(reads_until(source, [&] { return scans > 5 && is_good(Device::Scanner); }));

  source.stop();
  EXPECT_EQ(robot.disk_speed_rad_s(), 0.0);
  source.stop();
}

TEST_F(HardwareSourceTest, disk_brakes_while_nobody_reads_and_turns_again_when_somebody_does) {
  HardwareSource source(settings, ports(robot), [](drivers::HostStamp stamp_ns) { return stamp_ns / 1000; });
  ASSERT_TRUE(reads_until(source, [&] { return is_turning() && is_good(Device::Disk); }));
  const auto end = std::chrono::steady_clock::now() + 60s;
  while (robot.disk_speed_rad_s() != 0.0 && std::chrono::steady_clock::now() < end) std::this_thread::sleep_for(10ms);
  ASSERT_EQ(robot.disk_speed_rad_s(), 0.0);
  troubles.clear();
  ASSERT_TRUE(reads_until(source, [&] { return is_turning(); }));
  EXPECT_GE(troubles["acquisition held up"], 1);
  EXPECT_EQ(troubles["disk: speed not reached"], 0);
  source.stop();
}

TEST_F(HardwareSourceTest, disk_rests_with_its_motor_off_turns_again_and_follows_another_speed) {
  const auto utime_us = [](drivers::HostStamp stamp_ns) { return stamp_ns / 1000; };
  HardwareSource source(settings, ports(robot), utime_us);
  ASSERT_TRUE(reads_until(source, [&] { return is_turning() && scans > 0; }));
  EXPECT_EQ(source.order({false, settings.disk.speed_rad_s()}), "");
  ASSERT_TRUE(reads_until(source, [&] { return states[Device::Motor].text == "stopped"; }));
  EXPECT_TRUE(is_good(Device::Motor));
  EXPECT_LE(std::abs(robot.disk_speed_rad_s()), settings.motor.standstill_speed_rad_s);
  scans = 0;
  const drivers::HostStamp later_ns = robot.now_ns() + 300'000'000;
  ASSERT_TRUE(reads_until(source, [&] { return robot.now_ns() > later_ns; }));
  EXPECT_EQ(scans, 0);
  EXPECT_EQ(robot.disk_speed_rad_s(), 0.0);

  const double speed_rad_s = -2.0 * settings.disk.speed_rad_s();
  EXPECT_EQ(source.order({true, speed_rad_s}), "");
  EXPECT_TRUE(reads_until(source, [&] { return robot.disk_speed_rad_s() < 0.9 * speed_rad_s && scans > 0; }));
  EXPECT_EQ(source.order({true, 0.5 * speed_rad_s}), "");
  EXPECT_TRUE(reads_until(source, [&] { return std::abs(robot.disk_speed_rad_s() / speed_rad_s - 0.5) < 0.05; }));
  source.stop();
  EXPECT_EQ(robot.disk_speed_rad_s(), 0.0);
}

TEST_F(HardwareSourceTest, idle_from_the_start_leaves_the_motor_off) {
  config::Settings idle = settings;
  idle.disk.mode = drivers::DiskMode::Idle;
  HardwareSource source(idle, ports(robot), [](drivers::HostStamp stamp_ns) { return stamp_ns / 1000; });
  ASSERT_TRUE(reads_until(source, [&] { return is_good(Device::Motor) && is_good(Device::Scanner); }));
  EXPECT_EQ(states[Device::Motor].text, "stopped");
  EXPECT_EQ(robot.disk_speed_rad_s(), 0.0);
  EXPECT_EQ(scans, 0);
}

TEST_F(HardwareSourceTest, destruction_stops_the_disk_too) {
  {
    HardwareSource source(settings, ports(robot), [](drivers::HostStamp stamp_ns) { return stamp_ns / 1000; });
    ASSERT_TRUE(reads_until(source, [&] { return robot.disk_speed_rad_s() > 0.0; }));
  }
  EXPECT_EQ(robot.disk_speed_rad_s(), 0.0);
  robot.scanner().wait(100ms);  // it obeys with its next mirror turn
  robot.tamper([](const sim::SimulatedRobot::Parts& parts) {
    while (parts.scanner.take(parts.now_ns)) continue;
    EXPECT_FALSE(parts.scanner.is_streaming());
  });
}

TEST_F(HardwareSourceTest, machine_without_any_device_says_so_of_each_and_stops_at_once) {
  for (const Cable cable : {Cable::Scanner, Cable::Motor, Cable::Encoder}) robot.plug(cable, false);
  HardwareSource source(settings, ports(robot), [](drivers::HostStamp stamp_ns) { return stamp_ns / 1000; });
  const auto has_failed = [&](Device device) { return states[device].condition == Condition::Failed; };
  EXPECT_TRUE(reads_until(
      source, [&] { return has_failed(Device::Scanner) && has_failed(Device::Motor) && has_failed(Device::Encoder); }));
  EXPECT_NE(states[Device::Motor].text.find("removed"), std::string::npos);
}

TEST(UtimeOfMonotonic, is_the_time_of_day) {
  const std::int64_t utime_us = utime_of_monotonic_us(hardware_ports({}).now_ns());
  const auto since_epoch = std::chrono::system_clock::now().time_since_epoch();
  EXPECT_NEAR(static_cast<double>(utime_us),
              static_cast<double>(std::chrono::duration_cast<std::chrono::microseconds>(since_epoch).count()), 5e6);
}

}  // namespace
}  // namespace stairway::daemon
