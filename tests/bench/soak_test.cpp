// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
// The daemon for many sweeps: does its memory grow, does it lose or miscount anything?
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "ipc/channels.hpp"
#include "ipc/lcm_bus.hpp"
#include "ipc/message_codec.hpp"
#include "tests/integration/daemon_process.hpp"
#include "tests/integration/private_network.hpp"

namespace stairway::test {
namespace {

using namespace std::chrono_literals;

constexpr auto kPatience = 200s;  // for the next sweep

// Turns of 3 s, and a coarse grid: a sweep takes a third of a second, and every stage has something to do.
const std::vector<std::string> kLight{
    "--simulate=straight-flight",   "--set", "disk.period_s=3", "--set", "detector.voxel_mm=30", "--set",
    "detector.normals.radius_mm=80"};

std::vector<std::string> at_speed(const std::string& speed) {
  std::vector<std::string> arguments = kLight;
  arguments.insert(arguments.end(), {"--set", "simulate.speed=" + speed});
  return arguments;
}

int count_from_environment(const char* name, int usual) {
  const char* text = std::getenv(name);
  return text == nullptr ? usual : std::atoi(text);
}

/// A line of /proc/ID/status [kB], e.g. VmRSS.
long memory_kb(pid_t id, const std::string& name) {
  std::ifstream status("/proc/" + std::to_string(id) + "/status");
  for (std::string key; status >> key; status.ignore(1000, '\n')) {
    long value_kb = 0;
    if (key == name + ":" && status >> value_kb) return value_kb;
  }
  return 0;
}

struct Watched {
  std::int64_t sweeps = 0;            ///< answered
  std::int64_t without_stairway = 0;  ///< of the answers that were heard
  std::vector<long> rss_kb;           ///< after every answer that was heard
  std::map<std::string, std::int64_t> drops;
  std::int64_t device_troubles = 0;
  long peak_kb = 0;
};

/// Listens to a daemon until it has answered so many sweeps, and to its last words; empty when it falls silent.
std::optional<Watched> watch(const std::vector<std::string>& arguments, std::int64_t sweeps) {
  auto bus = ipc::LcmBus::open(ipc::BusOptions{}.url);
  if (!bus) return std::nullopt;
  const ipc::Channels channels;
  Watched watched;
  bool is_stopped = false;
  auto news = std::chrono::steady_clock::now();
  DaemonProcess daemon(arguments);
  const auto on_answer = [&](const ipc::BusMessage& message) {
    const auto answer = ipc::decode<ipc::StairwaysMessage>(message.bytes);
    if (!answer || !answer->is_final) return;
    watched.sweeps = answer->sweep + 1;
    watched.without_stairway += answer->detection.stairways.empty() ? 1 : 0;
    watched.rss_kb.push_back(memory_kb(daemon.id(), "VmRSS"));
    news = std::chrono::steady_clock::now();
  };
  const auto on_health = [&](const ipc::BusMessage& message) {
    const auto health = ipc::decode<ipc::HealthMessage>(message.bytes);
    if (!health) return;
    watched.drops = {health->drops.begin(), health->drops.end()};
    watched.device_troubles = 0;
    for (const ipc::DeviceHealth& device : health->devices) watched.device_troubles += device.troubles;
    is_stopped = health->state == "stopped";
  };
  if (!(*bus)->subscribe(channels.stairways, on_answer) || !(*bus)->subscribe(channels.health, on_health)) return {};
  while (watched.sweeps < sweeps) {
    if (!(*bus)->handle(100ms) || std::chrono::steady_clock::now() - news > kPatience) return std::nullopt;
  }
  watched.peak_kb = memory_kb(daemon.id(), "VmHWM");
  daemon.signal(SIGTERM);
  for (int i = 0; i < 100 && !is_stopped; ++i) {
    if (!(*bus)->handle(100ms)) return std::nullopt;
  }
  EXPECT_EQ(daemon.wait(kPatience), 0);
  return watched;
}

long median(std::vector<long> values) {
  std::nth_element(values.begin(), values.begin() + static_cast<long>(values.size() / 2), values.end());
  return values[values.size() / 2];
}

void expect_nothing_lost(const Watched& watched) {
  // Beams that end nowhere or too far, and those before the disk's index was seen.
  static const std::set<std::string> kNoLoss{"no-return", "out-of-limits", "angle-invalid"};
  for (const auto& [name, count] : watched.drops) EXPECT_TRUE(count == 0 || kNoLoss.contains(name)) << name << count;
  EXPECT_EQ(watched.device_troubles, 0);
  // So coarse a grid misses the flight now and then; a daemon that goes astray misses it from then on.
  EXPECT_LE(watched.without_stairway, 1 + watched.sweeps / 50);
}

class Soak : public testing::Test {
 protected:
  void SetUp() override {
    if (!has_private_network()) GTEST_SKIP() << "this kernel permits no network namespaces (unshare -n)";
  }
};

TEST_F(Soak, memory_stays_flat_from_sweep_to_sweep_and_nothing_goes_wrong) {
  const int sweeps = count_from_environment("STAIRWAY_SOAK_SWEEPS", 20);
  const auto watched = watch(at_speed("0"), sweeps);
  ASSERT_TRUE(watched);
  expect_nothing_lost(*watched);

  const auto& rss_kb = watched->rss_kb;
  ASSERT_GE(rss_kb.size(), 8u);
  const auto quarter = static_cast<long>(rss_kb.size() / 4);
  const long early_kb = median({rss_kb.begin() + quarter, rss_kb.begin() + 2 * quarter});
  const long late_kb = median({rss_kb.end() - quarter, rss_kb.end()});
  std::cout << watched->sweeps << " sweeps, memory after a sweep " << early_kb / 1024 << " MB in the second quarter, "
            << late_kb / 1024 << " MB in the last; at most " << watched->peak_kb / 1024 << " MB\n";
  // A leak of a cloud per sweep would be megabytes each; the allocator's own ups and downs are below this.
  EXPECT_LT(late_kb - early_kb, 10 * 1024);
}

TEST_F(Soak, at_the_pace_of_a_real_robot_nothing_is_dropped) {
  const auto watched = watch(at_speed("1"), count_from_environment("STAIRWAY_SOAK_REAL_TIME_SWEEPS", 1));
  ASSERT_TRUE(watched);
  expect_nothing_lost(*watched);
  std::cout << watched->sweeps << " sweeps in their own time, nothing dropped\n";
}

}  // namespace
}  // namespace stairway::test
