// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <memory>
#include <string>

#include "drivers/canopen/canopen_frames.hpp"
#include "drivers/canopen/cia402.hpp"
#include "drivers/host_clock.hpp"
#include "tests/integration/daemon_process.hpp"
#include "tests/virtual_bench/bus_monitor.hpp"
#include "tests/virtual_bench/machine.hpp"
#include "tests/virtual_bench/news.hpp"

namespace stairway::bench {
namespace {

using namespace std::chrono_literals;

// Generous, since other work on the host makes the machine slower still; nothing waits for it to pass.
constexpr auto kPatience = 60s;
constexpr int kNode = 1;

bool is_unwell(const ipc::HealthMessage& health, const std::string& device) {
  return std::ranges::any_of(health.devices, [&](const ipc::DeviceHealth& entry) {
    return entry.name == device && !entry.is_ok && health.state.find(device) != std::string::npos;
  });
}

std::int64_t troubles_in(const Heard& heard, const std::string& device) {
  if (!heard.health) return 0;
  const auto& devices = heard.health->devices;
  const auto entry = std::ranges::find(devices, device, &ipc::DeviceHealth::name);
  return entry == devices.end() ? 0 : entry->troubles;
}

bool is_scanning(const Heard& heard) { return heard.health && heard.health->state == "scanning"; }

// One daemon runs through the scenarios as it would through the days of a robot; it is started anew when a scenario
// ended it, or left it unwell.
class Daemon : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    Machine::get();
    news_ = std::make_unique<News>();
  }
  static void TearDownTestSuite() {
    daemon_.reset();
    news_.reset();
  }

  void start() {
    news_->clear();
    daemon_ = std::make_unique<test::DaemonProcess>(std::vector<std::string>{"--config", BENCH_SETTINGS});
  }
  void be_scanning() {
    if (!daemon_ || !daemon_->is_running()) start();
    if (!news_->wait(kPatience, is_scanning)) FAIL() << "not scanning but: " << state();
  }
  bool scans_again() {
    news_->clear();
    return news_->wait(kPatience, [](const Heard& heard) { return is_scanning(heard) && heard.scans > 40; });
  }
  // Whether health tells that the device is not well.
  bool tells_of(const std::string& device) {
    news_->clear();
    return news_->wait(kPatience, [&](const Heard& heard) { return heard.health && is_unwell(*heard.health, device); });
  }
  static std::int64_t troubles_of(const std::string& device) { return troubles_in(news_->heard(), device); }
  static std::string state() {
    const Heard heard = news_->heard();
    return heard.health ? heard.health->state : "no health was heard";
  }
  bool stands() const { return std::stod(machine_.order("disk speed")) == 0.0; }
  bool comes_to_rest(std::chrono::seconds timeout) const {
    const auto end = std::chrono::steady_clock::now() + timeout;
    while (!stands()) {
      if (std::chrono::steady_clock::now() > end) return false;
      std::this_thread::sleep_for(20ms);
    }
    return true;
  }
  // The daemon's last bytes may be on their way still when it has ended.
  bool scanner_rests() const {
    const auto end = std::chrono::steady_clock::now() + kPatience;
    while (machine_.order("scanner streaming") != "no") {
      if (std::chrono::steady_clock::now() > end) return false;
      std::this_thread::sleep_for(20ms);
    }
    return true;
  }

  Machine& machine_ = Machine::get();
  Rig& rig_ = machine_.rig();
  static std::unique_ptr<News> news_;
  static std::unique_ptr<test::DaemonProcess> daemon_;
};

std::unique_ptr<News> Daemon::news_;
std::unique_ptr<test::DaemonProcess> Daemon::daemon_;

TEST_F(Daemon, starts_without_devices_and_takes_each_as_it_comes) {
  daemon_.reset();
  rig_.unplug_scanner();
  rig_.remove_bus();
  rig_.remove_encoder_chip();
  start();
  EXPECT_TRUE(tells_of("scanner")) << state();
  EXPECT_TRUE(tells_of("disk motor")) << state();
  EXPECT_TRUE(tells_of("encoder")) << state();
  rig_.add_bus();
  EXPECT_TRUE(stands());
  rig_.add_encoder_chip();
  rig_.plug_scanner();
  EXPECT_TRUE(scans_again()) << state();
}

TEST_F(Daemon, sends_the_stairway_of_the_scene) {
  be_scanning();
  ASSERT_TRUE(news_->wait(kPatience, [](const Heard& heard) {
    return heard.answer && !heard.answer->detection.stairways.empty();
  })) << state();
  const detect::Stairway found = news_->heard().answer->detection.stairways.front();
  EXPECT_EQ(found.direction, detect::StairwayDirection::Ascending);
  EXPECT_NEAR(found.step_height, 0.17, 0.01);
  EXPECT_NEAR(found.step_depth, 0.29, 0.015);
  EXPECT_NEAR(found.anchor.x(), 2.0, 0.1);
}

TEST_F(Daemon, scanner_is_unplugged_and_plugged_in_again) {
  be_scanning();
  rig_.unplug_scanner();
  EXPECT_TRUE(tells_of("scanner")) << state();
  rig_.plug_scanner();
  EXPECT_TRUE(scans_again()) << state();
}

TEST_F(Daemon, scanner_falls_silent) {
  be_scanning();
  const std::int64_t troubles = troubles_of("scanner");
  machine_.order("scanner stuck");
  EXPECT_TRUE(scans_again()) << state();
  EXPECT_GT(troubles_of("scanner"), troubles);
}

TEST_F(Daemon, bus_goes_down_and_up) {
  be_scanning();
  rig_.lower_bus();
  EXPECT_TRUE(tells_of("disk motor")) << state();
  EXPECT_TRUE(comes_to_rest(kPatience));
  rig_.raise_bus();
  EXPECT_TRUE(scans_again()) << state();
}

TEST_F(Daemon, interface_is_removed_and_comes_back) {
  be_scanning();
  rig_.remove_bus();
  EXPECT_TRUE(tells_of("disk motor")) << state();
  EXPECT_TRUE(comes_to_rest(kPatience));
  rig_.add_bus();
  EXPECT_TRUE(scans_again()) << state();
}

TEST_F(Daemon, drive_has_a_fault_that_a_reset_clears) {
  be_scanning();
  const std::int64_t troubles = troubles_of("disk motor");
  machine_.order("drive fault");
  // It may be over before health tells of it.
  EXPECT_TRUE(news_->wait(kPatience, [&](const Heard& heard) { return troubles_in(heard, "disk motor") > troubles; }));
  EXPECT_TRUE(scans_again()) << state();
  EXPECT_FALSE(stands());
}

TEST_F(Daemon, drive_has_a_fault_that_stays_until_it_is_mended) {
  be_scanning();
  machine_.order("drive fault-stays");
  EXPECT_TRUE(tells_of("disk motor")) << state();
  EXPECT_TRUE(comes_to_rest(kPatience));
  machine_.order("drive mend");
  EXPECT_TRUE(scans_again()) << state();
}

TEST_F(Daemon, encoder_falls_silent) {
  be_scanning();
  machine_.order("encoder dead");
  EXPECT_TRUE(tells_of("disk")) << state();
  EXPECT_NE(state().find("encoder"), std::string::npos) << state();
  machine_.order("encoder mend");
  EXPECT_TRUE(scans_again()) << state();
}

TEST_F(Daemon, encoder_chip_is_removed_and_comes_back) {
  be_scanning();
  rig_.remove_encoder_chip();
  EXPECT_TRUE(tells_of("encoder")) << state();
  rig_.add_encoder_chip();
  EXPECT_TRUE(scans_again()) << state();
}

// What the last answer to a read of the statusword says, if there was one before that time.
std::optional<std::uint16_t> last_told_statusword(const std::vector<SeenFrame>& seen, drivers::HostStamp before_ns) {
  std::optional<std::uint16_t> word;
  for (const auto& [stamp_ns, frame] : seen) {
    if (stamp_ns >= before_ns) break;
    const bool is_process_data = frame.id == drivers::cob::kTpdo1 + kNode;
    // An upload of two bytes, of object 6041.
    const bool is_answer = frame.id == drivers::cob::kSdoAnswer + kNode && frame.data[0] == 0x4b &&
                           frame.data[1] == 0x41 && frame.data[2] == 0x60;
    if (!is_process_data && !is_answer) continue;
    const std::size_t first = is_answer ? 4 : 0;
    word = static_cast<std::uint16_t>(frame.data[first] | frame.data[first + 1] << 8);
  }
  return word;
}

TEST_F(Daemon, termination_stops_the_disk_before_the_process_ends) {
  be_scanning();
  ASSERT_FALSE(stands());
  const BusMonitor monitor(Rig::kBus);
  daemon_->signal(SIGTERM);
  EXPECT_EQ(daemon_->wait(20s), 0);
  const drivers::HostStamp end_ns = drivers::monotonic_now_ns();
  EXPECT_TRUE(stands());
  const auto word = last_told_statusword(monitor.frames(), end_ns);
  ASSERT_TRUE(word);
  EXPECT_TRUE(drivers::is_off(drivers::decode_statusword(*word))) << std::hex << *word;
  EXPECT_TRUE(scanner_rests());
}

TEST_F(Daemon, drive_brakes_by_itself_when_the_process_is_killed) {
  be_scanning();
  ASSERT_FALSE(stands());
  daemon_->signal(SIGKILL);
  EXPECT_EQ(daemon_->wait(5s), -1);
  EXPECT_TRUE(comes_to_rest(10s));
  EXPECT_NE(machine_.order("drive state"), drivers::to_string(drivers::DriveState::Enabled));
}

}  // namespace
}  // namespace stairway::bench
