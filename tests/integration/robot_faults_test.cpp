// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <functional>
#include <map>

#include "scan_assembly/sweep_assembler.hpp"
#include "tools/stairwayd/health_book.hpp"
#include "tools/stairwayd/simulated_source.hpp"

namespace stairway::daemon {
namespace {

using namespace std::chrono_literals;
using Cable = sim::SimulatedRobot::Cable;
using Parts = sim::SimulatedRobot::Parts;

config::Settings quick() {
  config::Settings settings;
  settings.simulate.scene = "empty-room";
  settings.simulate.speed = 0.0;
  settings.disk.period_s = 4.0;
  settings.lidar.skip_scan = 4;  // the scans themselves do not matter, and rays are what costs time
  return settings;
}

/// The simulated robot as the daemon reads it, with its health.
class Robot {
 public:
  explicit Robot(const config::Settings& settings = quick())
      : source_(settings, 0), assembler_(scan::make_calibration(settings.mount), settings.sweep) {}

  void read() {
    for (SourceEvent& event : source_.read(100ms)) std::visit([this](auto& what) { take(what); }, event);
    while (auto sweep = assembler_.take_sweep()) good_sweeps += sweep->statistics.flaws().empty() ? 1 : 0;
  }
  void run(double seconds) {
    const auto end_ns = robot().now_ns() + std::llround(1e9 * seconds);
    while (robot().now_ns() < end_ns) read();
  }
  /// @return Whether it came to that within so many simulated seconds.
  bool run_until(const std::function<bool()>& condition, double most_s) {
    const auto end_ns = robot().now_ns() + std::llround(1e9 * most_s);
    while (!condition() && robot().now_ns() < end_ns) read();
    return condition();
  }
  bool comes_to_scan(double most_s = 30.0) {
    return run_until([this] { return is_ok(); }, most_s);
  }
  bool comes_to_a_good_sweep() {
    const int before = good_sweeps;
    return run_until([&] { return good_sweeps > before; }, 30.0);
  }

  bool is_ok() {
    bool is_all_good = true;
    for (const auto& [device, state] : states) is_all_good = is_all_good && state.condition == Condition::Good;
    return is_all_good && is_turning();
  }
  bool is_turning() { return std::abs(robot().disk_speed_rad_s()) > 1.0; }
  std::uint64_t troubles(Device device) { return troubles_[device]; }
  void tamper(const std::function<void(const Parts&)>& change) { robot().tamper(change); }
  sim::SimulatedRobot& robot() { return source_.robot(); }
  SimulatedSource& source() { return source_; }

  std::map<Device, SourceState> states;
  int good_sweeps = 0;
  std::string last_trouble;
  std::vector<drivers::AngleSample> angles;

 private:
  void take(drivers::LaserScan& scan) { assembler_.add(std::move(scan)); }
  void take(const std::vector<drivers::AngleSample>& samples) {
    assembler_.add(samples);
    angles.insert(angles.end(), samples.begin(), samples.end());
  }
  void take(const SourceState& state) { states[state.device] = state; }
  void take(const SourceTrouble& trouble) {
    if (trouble.device) ++troubles_[*trouble.device];
    last_trouble = trouble.name + ": " + trouble.detail;
  }
  void take(const SourceSign&) {}
  void take(const SourceNote&) {}
  void take(RawBytes&) {}
  void take(const drivers::ClockQuality&) {}

  SimulatedSource source_;
  scan::SweepAssembler assembler_;
  std::map<Device, std::uint64_t> troubles_;
};

TEST(RobotFaults, healthy_robot_makes_good_sweeps_in_both_directions_without_a_trouble) {
  for (const double period_s : {4.0, -4.0}) {
    SCOPED_TRACE(period_s);
    config::Settings settings = quick();
    settings.disk.period_s = period_s;
    Robot robot(settings);
    ASSERT_TRUE(robot.comes_to_a_good_sweep());
    ASSERT_TRUE(robot.comes_to_a_good_sweep());
    for (const Device device : kDevices) EXPECT_EQ(robot.troubles(device), 0u) << robot.last_trouble;
    EXPECT_TRUE(robot.is_ok());
  }
}

TEST(RobotFaults, every_device_that_fails_while_turning_is_named_and_sweeps_come_again_when_it_is_back) {
  const struct {
    const char* what;
    Device device;
    const char* words;
    std::function<void(Robot&)> fail;
    std::function<void(Robot&)> mend;
  } cases[] = {
      {"scanner unplugged", Device::Scanner, "unplugged",
       [](Robot& robot) { robot.robot().plug(Cable::Scanner, false); },
       [](Robot& robot) { robot.robot().plug(Cable::Scanner, true); }},
      {"bus interface removed", Device::Motor, "removed", [](Robot& robot) { robot.robot().plug(Cable::Motor, false); },
       [](Robot& robot) { robot.robot().plug(Cable::Motor, true); }},
      {"bus down", Device::Motor, "down",
       [](Robot& robot) { robot.tamper([](const Parts& parts) { parts.bus.set_link(false, parts.now_ns); }); },
       [](Robot& robot) { robot.tamper([](const Parts& parts) { parts.bus.set_link(true, parts.now_ns); }); }},
      {"bus off", Device::Motor, "",
       [](Robot& robot) { robot.tamper([](const Parts& parts) { parts.bus.set_bus_off(true, parts.now_ns); }); },
       [](Robot& robot) { robot.tamper([](const Parts& parts) { parts.bus.set_bus_off(false, parts.now_ns); }); }},
      {"drive falls silent", Device::Motor, "",
       [](Robot& robot) { robot.tamper([](const Parts& parts) { parts.drive.faults().is_silent = true; }); },
       [](Robot& robot) { robot.tamper([](const Parts& parts) { parts.drive.faults().is_silent = false; }); }},
      {"drive fault that stays", Device::Motor, "",
       [](Robot& robot) {
         robot.tamper([](const Parts& parts) {
           parts.drive.faults().is_fault_stuck = true;
           parts.drive.raise_fault(0x2310, parts.now_ns);
         });
       },
       [](Robot& robot) { robot.tamper([](const Parts& parts) { parts.drive.faults().is_fault_stuck = false; }); }},
      {"GPIO chip removed", Device::Encoder, "", [](Robot& robot) { robot.robot().plug(Cable::Encoder, false); },
       [](Robot& robot) { robot.robot().plug(Cable::Encoder, true); }},
      {"encoder dead", Device::Disk, "the encoder",
       [](Robot& robot) {
         robot.tamper([](const Parts& parts) {
           parts.encoder.faults().is_a_dead = true;
           parts.encoder.faults().is_b_dead = true;
         });
       },
       [](Robot& robot) {
         robot.tamper([](const Parts& parts) {
           parts.encoder.faults().is_a_dead = false;
           parts.encoder.faults().is_b_dead = false;
         });
       }},
  };
  for (const auto& test : cases) {
    SCOPED_TRACE(test.what);
    Robot robot;
    ASSERT_TRUE(robot.comes_to_a_good_sweep());
    const std::uint64_t before = robot.troubles(test.device);
    test.fail(robot);
    ASSERT_TRUE(robot.run_until([&] { return robot.states[test.device].condition == Condition::Failed; }, 5.0));
    robot.run(1.0);
    const SourceState state = robot.states[test.device];
    EXPECT_NE(state.text.find(test.words), std::string::npos) << state.text;
    EXPECT_GT(robot.troubles(test.device), before);
    test.mend(robot);
    EXPECT_TRUE(robot.comes_to_scan(90.0)) << robot.states[test.device].text;
    EXPECT_TRUE(robot.comes_to_a_good_sweep());
  }
}

TEST(RobotFaults, fault_of_the_drive_is_reset_and_edges_that_were_lost_cost_less_than_a_turn) {
  Robot robot;
  ASSERT_TRUE(robot.comes_to_a_good_sweep());
  robot.tamper([](const Parts& parts) { parts.drive.raise_fault(0x2310, parts.now_ns); });
  robot.run(0.2);
  EXPECT_EQ(robot.states[Device::Motor].condition, Condition::Failed);
  EXPECT_TRUE(robot.comes_to_scan());

  robot.tamper([](const Parts& parts) { parts.encoder.faults().lost_edges = 3; });
  robot.run(0.2);
  EXPECT_EQ(robot.states[Device::Encoder].condition, Condition::Failed);
  EXPECT_TRUE(robot.comes_to_scan(5.0));
  EXPECT_TRUE(robot.comes_to_a_good_sweep());
}

TEST(RobotFaults, scanner_that_stays_away_lets_the_disk_rest_until_it_is_back) {
  config::Settings settings = quick();
  settings.disk.idle_after_s = 3.0;
  Robot robot(settings);
  ASSERT_TRUE(robot.comes_to_scan());
  robot.robot().plug(Cable::Scanner, false);
  robot.run(2.0);
  EXPECT_TRUE(robot.is_turning());
  robot.run(5.0);
  EXPECT_EQ(robot.robot().disk_speed_rad_s(), 0.0);
  robot.robot().plug(Cable::Scanner, true);
  EXPECT_TRUE(robot.comes_to_a_good_sweep());
}

TEST(RobotFaults, wrong_unit_is_found_by_the_self_check_before_the_disk_turns_fast) {
  Robot robot;
  robot.tamper([](const Parts& parts) { parts.drive.faults().disk_turns_per_turn = 4.0; });
  ASSERT_TRUE(robot.run_until([&] { return robot.states[Device::Disk].condition == Condition::Failed; }, 10.0));
  EXPECT_NE(robot.states[Device::Disk].text.find("4 times as fast"), std::string::npos)
      << robot.states[Device::Disk].text;
  robot.run(1.0);
  EXPECT_EQ(robot.robot().disk_speed_rad_s(), 0.0);
}

TEST(RobotFaults, disk_that_turns_against_the_command_is_stopped_quickly_and_tried_again_later) {
  config::Settings settings = quick();
  settings.motor.deceleration_rad_s2 = 0.3;  // an ordinary stop takes 5 s
  Robot robot(settings);
  ASSERT_TRUE(robot.comes_to_a_good_sweep());
  robot.tamper([](const Parts& parts) { parts.drive.faults().is_velocity_reversed = true; });
  const auto is_paused = [&] { return robot.states[Device::Disk].reason == "wrong direction"; };
  ASSERT_TRUE(robot.run_until(is_paused, 20.0));
  EXPECT_TRUE(robot.run_until([&] { return robot.robot().disk_speed_rad_s() == 0.0; }, 1.0));
  EXPECT_TRUE(robot.run_until([&] { return robot.states[Device::Motor].text == "stopped"; }, 3.0));
  robot.tamper([](const Parts& parts) {
    EXPECT_NE(parts.drive.state(), drivers::DriveState::Enabled);
    parts.drive.faults().is_velocity_reversed = false;
  });
  EXPECT_TRUE(robot.comes_to_scan(settings.disk.retry_s + 30.0));
}

TEST(RobotFaults, stop_ends_with_a_disk_that_stands_and_a_drive_that_is_off) {
  Robot robot;
  ASSERT_TRUE(robot.comes_to_scan());
  robot.source().stop();
  robot.robot().scanner().wait(100ms);  // the scanner obeys with its next mirror turn
  robot.tamper([](const Parts& parts) {
    while (parts.scanner.take(parts.now_ns)) continue;
    EXPECT_EQ(parts.drive.disk_speed_rad_s(), 0.0);
    EXPECT_NE(parts.drive.state(), drivers::DriveState::Enabled);
    EXPECT_FALSE(parts.scanner.is_streaming());
  });
  robot.source().stop();
}

TEST(RobotFaults, robot_without_an_encoder_takes_the_angles_of_its_drive) {
  config::Settings settings = quick();
  settings.disk.angle_source = drivers::AngleSource::Drive;
  Robot robot(settings);
  ASSERT_TRUE(robot.comes_to_a_good_sweep());
  EXPECT_FALSE(robot.states.contains(Device::Encoder));
  EXPECT_TRUE(robot.angles.back().valid);
}

}  // namespace
}  // namespace stairway::daemon
