// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <csignal>
#include <filesystem>
#include <fstream>

#include "tests/integration/daemon_process.hpp"
#include "tests/integration/listener.hpp"
#include "tests/integration/private_network.hpp"
#include "tools/sim/scene_file.hpp"

namespace stairway::test {
namespace {

using namespace std::chrono_literals;

// Generous, since sanitizers make the daemon ten times slower; nothing waits for it to pass.
constexpr auto kPatience = 200s;

// Whole sweeps only.
std::vector<std::string> quick(const std::string& scene, std::vector<std::string> more = {}) {
  std::vector<std::string> arguments{"--simulate=" + scene, "--set", "simulate.speed=0", "--set",
                                     "disk.period_s=6",     "--set", "preview.every_s=0"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return arguments;
}

bool has_answer(const Listener& listener) { return !listener.answers.empty(); }
bool has_health(const Listener& listener) { return !listener.healths.empty(); }

std::int64_t utime_now_us() {
  const auto since_epoch = std::chrono::system_clock::now().time_since_epoch();
  return std::chrono::duration_cast<std::chrono::microseconds>(since_epoch).count();
}

// How many threads of the process, beside its first, which waits for signals, do not block the signal.
int threads_open_to(pid_t process, int signal) {
  int count = 0;
  for (const auto& entry : std::filesystem::directory_iterator("/proc/" + std::to_string(process) + "/task")) {
    if (entry.path().filename() == std::to_string(process)) continue;
    std::ifstream status(entry.path() / "status");
    for (std::string line; std::getline(status, line);) {
      if (!line.starts_with("SigBlk:")) continue;
      const std::uint64_t blocked = std::stoull(line.substr(7), nullptr, 16);
      if ((blocked >> (signal - 1) & 1U) == 0) ++count;
    }
  }
  return count;
}

class Stairwayd : public testing::Test {
 protected:
  void SetUp() override {
    if (!has_private_network()) GTEST_SKIP() << "this kernel permits no network namespaces (unshare -n)";
    add_multicast_route();
  }
};

TEST_F(Stairwayd, finds_the_stairway_of_the_simulated_scene) {
  Listener listener;
  DaemonProcess daemon(quick("straight-flight"));
  ASSERT_TRUE(listener.listen(kPatience, has_answer));
  const ipc::StairwaysMessage& answer = listener.answers.front();
  const detect::Stairway truth = sim::build_scene(sim::load_scene("straight-flight")).truths.front();

  EXPECT_EQ(answer.sweep, 0);
  EXPECT_TRUE(answer.is_final);
  EXPECT_NEAR(static_cast<double>(answer.utime_us - answer.sweep_start_utime_us), 6e6, 0.2e6);
  ASSERT_EQ(answer.detection.stairways.size(), 1u);
  EXPECT_EQ(answer.track_ids, std::vector<std::int64_t>{1});
  const detect::Stairway& found = answer.detection.stairways.front();
  EXPECT_EQ(found.direction, truth.direction);
  EXPECT_NEAR(found.step_height, truth.step_height, 0.005);
  EXPECT_NEAR(found.step_depth, truth.step_depth, 0.008);
  EXPECT_LT((found.anchor - truth.anchor).norm(), 0.05);
}

TEST_F(Stairwayd, tells_a_stairway_before_the_turn_is_over_and_logs_that_once) {
  Listener listener;
  DaemonProcess daemon(quick("straight-flight", {"--set", "preview.every_s=0.5"}));
  const auto has_final = [](const Listener& heard) { return !heard.answers.empty() && heard.answers.back().is_final; };
  ASSERT_TRUE(listener.listen(kPatience, has_final));
  ASSERT_GE(listener.answers.size(), 3u);
  const ipc::StairwaysMessage &first = listener.answers.front(), &last = listener.answers.back();
  EXPECT_FALSE(first.is_final);
  EXPECT_EQ(first.sweep, last.sweep);
  EXPECT_EQ(first.track_ids, last.track_ids);
  EXPECT_LT(first.utime_us, last.utime_us - 2'000'000);
  ASSERT_TRUE(daemon.has_said("stairway 1: ", kPatience));
  const std::string log = daemon.output(), news = "stairway 1 comes into sight: ";
  ASSERT_NE(log.find(news), std::string::npos) << log;
  EXPECT_EQ(log.find(news), log.rfind(news)) << log;
  EXPECT_LT(log.find(news), log.find("stairway 1: ")) << log;
}

TEST_F(Stairwayd, tells_what_it_measures_and_how_it_does) {
  Listener listener;
  DaemonProcess daemon(quick("straight-flight"));
  // The first measurements are of a disk that has not passed its index yet.
  const auto has_everything = [](const Listener& heard) {
    return heard.scans.size() > 20 && heard.scans.back().disk_angle_valid && heard.disks.size() > 20 &&
           heard.disks.back().index_count > 0 && !heard.healths.empty() && heard.healths.back().state == "scanning" &&
           !heard.settings.empty();
  };
  ASSERT_TRUE(listener.listen(kPatience, has_everything));

  const ipc::ScanMessage& scan = listener.scans.back();
  EXPECT_EQ(scan.scan.ranges_m.size(), 1081u);
  EXPECT_TRUE(scan.disk_angle_valid);
  // 1080 of 1440 beams in 25 ms, of a turn in 6 s.
  EXPECT_NEAR(scan.disk_angle_end_rad - scan.disk_angle_start_rad, 2.0 * M_PI * 0.01875 / 6.0, 1e-3);
  EXPECT_GT(scan.scan.sequence, listener.scans.front().scan.sequence);

  for (std::size_t i = 1; i < listener.disks.size(); ++i)
    EXPECT_GE(listener.disks[i].utime_us - listener.disks[i - 1].utime_us, 100'000);
  EXPECT_NEAR(listener.disks.back().speed_rad_s, 2.0 * M_PI / 6.0, 0.02);
  EXPECT_GE(listener.disks.back().index_count, 1);

  const ipc::HealthMessage& health = listener.healths.back();
  EXPECT_EQ(health.state, "scanning");
  EXPECT_GT(health.scan_rate_hz, 0.0);
  EXPECT_GT(health.disk_rate_hz, 0.0);
  EXPECT_GE(health.sweep_progress, 0.0);
  EXPECT_LE(health.sweep_progress, 1.0);
  EXPECT_TRUE(health.reasons.empty()) << health.reasons.front();
  ASSERT_EQ(health.devices.size(), 4u);
  for (const ipc::DeviceHealth& device : health.devices) {
    EXPECT_TRUE(device.is_ok) << device.name << ": " << device.state;
    EXPECT_EQ(device.rate_hz > 0.0, device.name != "disk") << device.name;
  }
  EXPECT_GT(health.clock.period_ms, 0.0);
  ASSERT_FALSE(health.stages.empty());
  EXPECT_EQ(health.stages.front().name, "acquisition");

  EXPECT_NE(listener.settings.front().toml.find("\nperiod_s = 6"), std::string::npos);
  EXPECT_FALSE(listener.settings.front().version.empty());
}

TEST_F(Stairwayd, says_why_it_found_nothing) {
  Listener listener;
  DaemonProcess daemon(quick("empty-room"));
  ASSERT_TRUE(listener.listen(kPatience, has_answer));
  EXPECT_TRUE(listener.answers.front().detection.stairways.empty());
  EXPECT_TRUE(daemon.has_said("no stairway in sweep 0; ", kPatience));
}

TEST_F(Stairwayd, once_ends_after_the_first_answer) {
  Listener listener;
  DaemonProcess daemon(quick("straight-flight", {"--once", "--set", "preview.every_s=1"}));
  EXPECT_TRUE(listener.listen(kPatience, [](const Listener& heard) {
    return has_answer(heard) && !heard.healths.empty() && heard.healths.back().state == "stopped";
  }));
  EXPECT_EQ(daemon.wait(kPatience), 0);
  EXPECT_EQ(std::ranges::count(listener.answers, true, &ipc::StairwaysMessage::is_final), 1);
}

TEST_F(Stairwayd, termination_is_quick_and_clean_in_the_middle_of_a_pass) {
  // Sweeps are simulated faster than the detector takes them, so one is always under way after the first.
  DaemonProcess daemon(quick("straight-flight"));
  Listener listener;
  const auto is_detecting = [](const Listener& heard) { return has_health(heard) && heard.healths.back().sweep > 0; };
  ASSERT_TRUE(listener.listen(kPatience, is_detecting));
  daemon.signal(SIGTERM);
  EXPECT_EQ(daemon.wait(2s), 0);
  EXPECT_TRUE(listener.listen(2s, [](const Listener& heard) { return heard.healths.back().state == "stopped"; }));
}

TEST_F(Stairwayd, at_speed_one_measurements_bear_the_time_of_day) {
  Listener listener;
  DaemonProcess daemon({"--simulate=straight-flight"});
  ASSERT_TRUE(listener.listen(kPatience, [](const Listener& heard) { return heard.disks.size() > 5; }));
  const auto age_us = static_cast<double>(utime_now_us() - listener.disks.back().utime_us);
  EXPECT_NEAR(age_us, 0.0, 5e6);
}

TEST_F(Stairwayd, lives_through_a_missing_multicast_route_and_sends_when_it_comes) {
  remove_multicast_route();
  DaemonProcess daemon({"--simulate=straight-flight"});
  ASSERT_TRUE(daemon.has_said("ip route add 224.0.0.0/4 dev lo; trying again", kPatience));
  EXPECT_EQ(daemon.wait(1s), std::nullopt);
  add_multicast_route();
  Listener listener;
  EXPECT_TRUE(listener.listen(20s, [](const Listener& heard) { return has_health(heard) && !heard.settings.empty(); }));
}

TEST_F(Stairwayd, hangup_reads_the_settings_again) {
  const auto file = std::filesystem::path(testing::TempDir()) / ("hangup_" + std::to_string(::getpid()) + ".toml");
  std::ofstream(file) << "[detector]\nvoxel_mm = 10\n";
  Listener listener;
  DaemonProcess daemon({"--simulate=straight-flight", "--config", file.string()});
  ASSERT_TRUE(listener.listen(kPatience, [](const Listener& heard) { return !heard.settings.empty(); }));

  std::ofstream(file) << "[detector]\nvoxel_mm = oops\n";
  daemon.signal(SIGHUP);
  EXPECT_TRUE(daemon.has_said("settings kept: " + file.string() + ":2:", 5s));

  std::ofstream(file) << "[detector]\nvoxel_mm = 25\n[mount]\ndisk_z_mm = 700\n";
  daemon.signal(SIGHUP);
  EXPECT_TRUE(daemon.has_said("mount.disk_z_mm changes only with a restart", 5s));
  EXPECT_TRUE(listener.listen(
      5s, [](const Listener& heard) { return heard.settings.back().toml.find("voxel_mm = 25") != std::string::npos; }));
  EXPECT_NE(listener.settings.back().toml.find("disk_z_mm = 500"), std::string::npos);
  std::filesystem::remove(file);
}

TEST_F(Stairwayd, tells_systemd_that_it_is_ready_and_alive) {
  const auto path = std::filesystem::path(testing::TempDir()) / ("notify_" + std::to_string(::getpid()));
  sockaddr_un address{AF_UNIX, {}};
  path.string().copy(address.sun_path, sizeof(address.sun_path) - 1);
  const int socket = ::socket(AF_UNIX, SOCK_DGRAM, 0);
  ASSERT_EQ(::bind(socket, reinterpret_cast<const sockaddr*>(&address), sizeof(address)), 0);
  const timeval timeout{10, 0};
  ::setsockopt(socket, SOL_SOCKET, SO_RCVTIMEO, &timeout, sizeof(timeout));

  DaemonProcess daemon({"--simulate=straight-flight"}, {"NOTIFY_SOCKET=" + path.string()});
  std::string told;
  std::array<char, 1000> datagram;
  while (told.find("WATCHDOG=1") == std::string::npos) {
    const ssize_t size = ::recv(socket, datagram.data(), datagram.size(), 0);
    ASSERT_GT(size, 0) << told;
    told.append(datagram.data(), static_cast<std::size_t>(size)).append("\n");
  }
  EXPECT_TRUE(told.starts_with("READY=1\n")) << told;
  EXPECT_NE(told.find("STATUS="), std::string::npos) << told;
  EXPECT_NE(told.find("no answer yet"), std::string::npos) << told;
  ::close(socket);
  std::filesystem::remove(path);
}

TEST_F(Stairwayd, lines_for_the_journal_bear_their_priority) {
  remove_multicast_route();
  DaemonProcess daemon({"--simulate=straight-flight"}, {"JOURNAL_STREAM=8:1"});
  EXPECT_TRUE(daemon.has_said("\n<6>stairwayd ", 5s));
  EXPECT_TRUE(daemon.has_said("\n<4>cannot open LCM", 5s));
}

TEST(StairwaydSettings, wrong_value_ends_with_78_and_names_file_line_and_key) {
  const auto file = std::filesystem::path(testing::TempDir()) / ("bad_" + std::to_string(::getpid()) + ".toml");
  std::ofstream(file) << "# wrong\n[simulate]\nspeed = \"fast\"\n";
  DaemonProcess daemon({"--simulate", "--config", file.string()});
  EXPECT_EQ(daemon.wait(kPatience), 78);
  EXPECT_EQ(daemon.output().find("stairwayd: " + file.string() + ":3:"), 0u) << daemon.output();
  EXPECT_NE(daemon.output().find("simulate.speed"), std::string::npos) << daemon.output();
  std::filesystem::remove(file);
}

TEST(StairwaydSettings, folder_beside_the_file_overrides_it) {
  const auto folder = std::filesystem::path(testing::TempDir()) / ("settings_" + std::to_string(::getpid()));
  std::filesystem::create_directories(folder / "conf.d");
  std::ofstream(folder / "stairwayd.toml") << "[lcm]\nchannel_prefix = \"A_\"\n";
  std::ofstream(folder / "conf.d/20-wrong.toml") << "[lcm]\nurl = 1\n";
  DaemonProcess daemon({"--check-config", "--config", (folder / "stairwayd.toml").string()});
  EXPECT_EQ(daemon.wait(kPatience), 78);
  EXPECT_NE(daemon.output().find("conf.d/20-wrong.toml:2:"), std::string::npos) << daemon.output();
  std::filesystem::remove_all(folder);
}

TEST(StairwaydSettings, unknown_scene_ends_with_78_and_lists_those_there_are) {
  DaemonProcess daemon({"--simulate=moon"});
  EXPECT_EQ(daemon.wait(kPatience), 78);
  EXPECT_NE(daemon.output().find("\"moon\""), std::string::npos) << daemon.output();
  EXPECT_NE(daemon.output().find("straight-flight"), std::string::npos) << daemon.output();
}

TEST(StairwaydSettings, good_ones_are_said_to_be_in_order) {
  DaemonProcess daemon({"--check-config", "--set", "detector.voxel_mm=15"});
  EXPECT_EQ(daemon.wait(kPatience), 0);
  EXPECT_EQ(daemon.output(), "the settings are in order\n");
}

TEST_F(Stairwayd, without_any_device_it_says_what_is_missing_and_goes_on_until_it_is_stopped) {
  Listener listener;
  DaemonProcess daemon({"--set", "motor.interface=nocan0", "--set", "encoder.chip=nochip"});
  const auto has_named_all = [](const Listener& heard) {
    if (heard.healths.empty() || heard.healths.back().devices.size() < 4) return false;
    const std::string& state = heard.healths.back().state;
    return state.find("scanner: ") != std::string::npos && state.find("disk motor: ") != std::string::npos &&
           state.find("encoder: ") != std::string::npos;
  };
  ASSERT_TRUE(listener.listen(kPatience, has_named_all));
  for (const ipc::DeviceHealth& device : listener.healths.back().devices) {
    EXPECT_EQ(device.is_ok, device.name == "disk") << device.name << ": " << device.state;
    EXPECT_EQ(device.reason.empty(), device.is_ok) << device.name;
    EXPECT_LT(device.data_age_s, 0.0);
  }
  // A thread that takes the signal instead of the one that waits for it would leave the disk turning.
  EXPECT_EQ(threads_open_to(daemon.id(), SIGTERM), 0);
  daemon.signal(SIGTERM);
  EXPECT_EQ(daemon.wait(kPatience), 0);
}

}  // namespace
}  // namespace stairway::test
