// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <csignal>
#include <numbers>

#include "tests/integration/daemon_process.hpp"
#include "tests/integration/listener.hpp"
#include "tests/integration/private_network.hpp"

namespace stairway::test {
namespace {

using namespace std::chrono_literals;

// Generous, since sanitizers make the daemon ten times slower; nothing waits for it to pass.
constexpr auto kPatience = 200s;

// A disk that turns in four seconds, four times as fast as real, with scans that are quickly made.
const std::vector<std::string> kDaemon{"--simulate=empty-room", "--set", "simulate.speed=4",        "--set",
                                       "disk.mode=idle",        "--set", "disk.period_s=4",         "--set",
                                       "lidar.cluster=10",      "--set", "disk.check_window_s=0.3", "--set",
                                       "preview.every_s=0"};

struct Answer {
  int exit_code = -1;
  std::string text;
};

Answer command(std::vector<std::string> arguments, const std::string& patience_s = "100") {
  const std::vector<std::string> before{"command", "--timeout", patience_s};
  arguments.insert(arguments.begin(), before.begin(), before.end());
  DaemonProcess companion(arguments, {}, STAIRWAY);
  const int exit_code = companion.wait(kPatience).value_or(-1);
  return {exit_code, companion.output()};
}

bool is_idle(const Listener& heard) {
  if (heard.healths.empty()) return false;
  const ipc::HealthMessage& health = heard.healths.back();
  bool is_motor_off = false;
  for (const ipc::DeviceHealth& device : health.devices)
    is_motor_off = is_motor_off || (device.name == "disk motor" && device.is_ok && device.state == "stopped");
  return health.state == "idle: the disk rests until a command" && is_motor_off && health.scan_rate_hz == 0.0;
}

bool is_standing(const Listener& heard) {
  return !heard.disks.empty() && std::abs(heard.disks.back().speed_rad_s) < 0.01;
}

class Command : public testing::Test {
 protected:
  void SetUp() override {
    if (!has_private_network()) GTEST_SKIP() << "this kernel permits no network namespaces (unshare -n)";
    add_multicast_route();
  }
};

TEST_F(Command, idle_daemon_makes_one_whole_sweep_on_command_and_rests_again) {
  Listener listener;
  DaemonProcess daemon(kDaemon);
  ASSERT_TRUE(listener.listen(kPatience, is_idle)) << daemon.output();
  EXPECT_TRUE(listener.scans.empty());

  const Answer single = command({"single"});
  EXPECT_EQ(single.exit_code, 0);
  EXPECT_EQ(single.text, "accepted: a single sweep, a turn in 4.0 s\n");
  EXPECT_TRUE(listener.listen(
      kPatience, [](const Listener& heard) { return !heard.answers.empty() && heard.answers.back().is_final; }));
  const std::size_t old_healths = listener.healths.size();
  EXPECT_TRUE(listener.listen(kPatience, [&](const Listener& heard) {
    return heard.healths.size() > old_healths && is_idle(heard) && is_standing(heard);
  })) << daemon.output();
  const std::size_t answers = listener.answers.size();
  const std::size_t scans = listener.scans.size();
  EXPECT_GT(scans, 100u);

  const std::size_t healths = listener.healths.size();
  EXPECT_TRUE(listener.listen(kPatience, [&](const Listener& heard) { return heard.healths.size() > healths + 2; }));
  EXPECT_LE(listener.answers.size(), answers + 1);
  EXPECT_LE(listener.scans.size(), scans + 40) << "only those that waited for their angle";
  daemon.signal(SIGTERM);
  EXPECT_EQ(daemon.wait(20s), 0);
}

TEST_F(Command, disk_starts_changes_its_speed_and_stops) {
  Listener listener;
  DaemonProcess daemon(kDaemon);
  ASSERT_TRUE(listener.listen(kPatience, is_idle)) << daemon.output();
  EXPECT_EQ(command({"start"}).exit_code, 0);
  const auto turns_at = [&](double speed_deg_s) {
    const double wanted_rad_s = speed_deg_s * std::numbers::pi / 180.0;
    return listener.listen(kPatience, [&](const Listener& heard) {
      return !heard.disks.empty() && std::abs(heard.disks.back().speed_rad_s - wanted_rad_s) < 0.03;
    });
  };
  EXPECT_TRUE(turns_at(90.0));

  const Answer slow = command({"speed", "1"});
  EXPECT_EQ(slow.exit_code, 1);
  EXPECT_EQ(slow.text.find("bad-value: a turn must take 1 to 60 s"), 0u) << slow.text;
  EXPECT_EQ(command({"speed", "60"}).text, "accepted: continuous sweeps, a turn in 6.0 s\n");
  EXPECT_TRUE(turns_at(60.0));
  // The sweep in which the speed changed is not lost.
  EXPECT_TRUE(listener.listen(
      kPatience, [](const Listener& heard) { return heard.answers.size() >= 2 && heard.answers.back().is_final; }));
  const std::string json = command({"speed", "--format", "json", "--", "-90"}).text;
  EXPECT_NE(json.find("\"result\":\"accepted\""), std::string::npos) << json;
  EXPECT_NE(json.find("\"mode\":\"continuous\""), std::string::npos) << json;
  EXPECT_TRUE(turns_at(-90.0));

  EXPECT_EQ(command({"stop"}).text, "accepted: idle: the disk rests, the motor is off\n");
  EXPECT_TRUE(listener.listen(kPatience, [](const Listener& heard) { return is_idle(heard) && is_standing(heard); }));
  // On a slow computer the detector leaves out sweeps, and says so.
  const bool is_too_slow = daemon.output().find("the detector is slower than the disk") != std::string::npos;
  for (std::size_t i = 1; i < listener.answers.size(); ++i) {
    const auto step = listener.answers[i].sweep - listener.answers[i - 1].sweep;
    EXPECT_TRUE(step == 1 || (is_too_slow && step > 1)) << step;
  }
}

TEST_F(Command, daemon_that_listens_to_another_one_refuses) {
  DaemonProcess daemon({"--source", "lcm"});
  Listener listener;
  ASSERT_TRUE(listener.listen(kPatience, [](const Listener& heard) { return !heard.healths.empty(); }));
  const Answer answer = command({"stop"}, "1.5");
  EXPECT_EQ(answer.exit_code, 1);
  EXPECT_EQ(answer.text.find("wrong-source: this daemon listens to another process"), 0u) << answer.text;
}

TEST_F(Command, without_a_daemon_the_companion_says_so) {
  const Answer answer = command({"stop"}, "0.3");
  EXPECT_EQ(answer.exit_code, 1);
  EXPECT_NE(answer.text.find("no answer within 0.3 s: does stairwayd run"), std::string::npos) << answer.text;
  EXPECT_EQ(command({"speed"}).exit_code, 2);
  EXPECT_EQ(command({"stop", "5"}).exit_code, 2);
}

}  // namespace
}  // namespace stairway::test
