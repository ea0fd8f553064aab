// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <map>

#include "ipc/channels.hpp"
#include "ipc/message_codec.hpp"
#include "ipc/recording/event_log_reader.hpp"
#include "tests/integration/daemon_process.hpp"
#include "tests/integration/listener.hpp"
#include "tests/integration/private_network.hpp"
#include "tests/tools/temporary_folder.hpp"

namespace stairway::test {
namespace {

using namespace std::chrono_literals;

// Generous, since sanitizers make the daemon ten times slower; nothing waits for it to pass.
constexpr auto kPatience = 200s;

const ipc::Channels kChannels;

// Settings of both runs, since they decide the answers. Previews depend on when the detector has time.
std::vector<std::string> with_settings(std::vector<std::string> arguments) {
  for (const char* setting : {"detector.voxel_mm=30", "disk.period_s=3", "record.min_free_mb=0", "preview.every_s=0"})
    arguments.insert(arguments.end(), {"--set", setting});
  return arguments;
}

std::filesystem::path only_file(const std::filesystem::path& folder) {
  std::error_code none;
  for (const auto& entry : std::filesystem::directory_iterator(folder, none)) return entry.path();
  return {};
}

/// Records the simulated robot until it has given an answer to a whole turn.
std::filesystem::path record_run(const std::string& folder) {
  DaemonProcess daemon(
      with_settings({"--simulate=straight-flight", "--set", "simulate.speed=0", "--set", "lcm.url=memq://", "--set",
                     "record.mode=continuous", "--set", "record.folder=" + folder, "--log-level", "debug"}));
  EXPECT_TRUE(daemon.has_said("sweep 1: ", kPatience));
  daemon.signal(SIGTERM);
  EXPECT_EQ(daemon.wait(kPatience), 0);
  return only_file(folder);
}

std::vector<ipc::Bytes> messages_in(const std::filesystem::path& path, const std::string& channel) {
  std::vector<ipc::Bytes> messages;
  auto reader = ipc::EventLogReader::open(path);
  if (!reader) return messages;
  while (const auto event = reader->next()) {
    if (event->channel == channel) messages.emplace_back(event->bytes.begin(), event->bytes.end());
  }
  return messages;
}

/// By the number of their sweep. A busy computer leaves out sweeps, and others in every run.
std::map<std::int64_t, ipc::Bytes> by_sweep(const std::vector<ipc::Bytes>& answers) {
  std::map<std::int64_t, ipc::Bytes> sweeps;
  for (const ipc::Bytes& answer : answers) {
    const auto message = ipc::decode<ipc::StairwaysMessage>(answer);
    EXPECT_TRUE(message);
    if (message) sweeps[message->sweep] = answer;
  }
  return sweeps;
}

/// How many of `sent` are missing among `heard` before its last one.
std::size_t lost(const std::vector<ipc::Bytes>& sent, const std::vector<ipc::Bytes>& heard) {
  std::size_t lost = 0;
  auto next = sent.begin();
  for (const ipc::Bytes& message : heard) {
    const auto place = std::find(next, sent.end(), message);
    if (place == sent.end()) continue;
    lost += static_cast<std::size_t>(place - next);
    next = place + 1;
  }
  return lost;
}

std::optional<ipc::DeviceHealth> scanner_of(const Listener& heard) {
  if (heard.healths.empty()) return std::nullopt;
  for (const ipc::DeviceHealth& device : heard.healths.back().devices) {
    if (device.name == "scanner") return device;
  }
  return std::nullopt;
}

bool says_of_scanner(const Listener& heard, const std::string& text) {
  const auto scanner = scanner_of(heard);
  return scanner && scanner->state.find(text) != std::string::npos;
}

class LcmSourceTest : public testing::Test {
 protected:
  void SetUp() override {
    if (!has_private_network()) GTEST_SKIP() << "this kernel permits no network namespaces (unshare -n)";
    add_multicast_route();
  }
};

TEST_F(LcmSourceTest, replayed_measurements_give_the_stairways_of_the_run_and_are_not_sent_again) {
  const TemporaryFolder folder;
  const auto file = record_run(folder.path("live"));
  const auto answers = messages_in(file, kChannels.stairways);
  ASSERT_FALSE(answers.empty());

  Listener listener;
  DaemonProcess daemon(with_settings(
      {"--source", "lcm", "--set", "record.mode=continuous", "--set", "record.folder=" + folder.path("heard")}));
  ASSERT_TRUE(listener.listen(
      kPatience, [](const Listener& heard) { return says_of_scanner(heard, "waiting for STAIRWAY_SCAN at udpm://"); }));
  DaemonProcess player({"replay", file, "--rate", "2", "--channels", "STAIRWAY_(SCAN|ANGLES|DISK)"}, {}, STAIRWAY);
  EXPECT_TRUE(listener.listen(kPatience, [](const Listener& heard) { return !heard.answers.empty(); }))
      << daemon.output();
  EXPECT_EQ(player.wait(kPatience), 0);
  EXPECT_TRUE(
      listener.listen(kPatience, [](const Listener& heard) { return says_of_scanner(heard, "nothing more comes"); }));
  EXPECT_FALSE(scanner_of(listener)->is_ok);
  daemon.signal(SIGTERM);
  EXPECT_EQ(daemon.wait(kPatience), 0);

  const auto heard_file = only_file(folder.path("heard"));
  const auto sent = messages_in(file, kChannels.scan), heard = messages_in(heard_file, kChannels.scan);
  EXPECT_LE(listener.scans.size(), sent.size()) << "a daemon that sent them again would double them";
  EXPECT_GT(listener.scans.size(), sent.size() / 2);
  EXPECT_GT(heard.size(), sent.size() / 2);
  const auto again = messages_in(heard_file, kChannels.stairways);
  ASSERT_FALSE(again.empty());
  const std::size_t lost_angles = lost(messages_in(file, kChannels.angles), messages_in(heard_file, kChannels.angles));
  if (lost(sent, heard) + lost_angles > 0) GTEST_SKIP() << "a busy computer lost messages on their way";
  const auto live_answers = by_sweep(answers);
  int compared = 0;
  for (const auto& [sweep, answer] : by_sweep(again)) {
    const auto live = live_answers.find(sweep);
    if (live == live_answers.end()) continue;
    EXPECT_EQ(answer, live->second) << sweep;
    ++compared;
  }
  if (compared == 0) GTEST_SKIP() << "a busy computer left out all sweeps that the live run had answered";
}

TEST_F(LcmSourceTest, file_for_a_url_is_refused) {
  DaemonProcess daemon({"--source", "lcm", "--set", "source.lcm_url=file:///tmp/a.lcm"});
  EXPECT_EQ(daemon.wait(kPatience), 78);
  EXPECT_NE(daemon.output().find("--replay plays a file"), std::string::npos) << daemon.output();
}

TEST_F(LcmSourceTest, scans_can_be_kept_from_the_network) {
  Listener listener;
  DaemonProcess daemon(with_settings({"--simulate=straight-flight", "--set", "lcm.scans=false"}));
  EXPECT_TRUE(listener.listen(kPatience, [](const Listener& heard) {
    return !heard.healths.empty() && heard.healths.back().scan_rate_hz > 0.0 && heard.disks.size() > 5;
  }));
  EXPECT_TRUE(listener.scans.empty());
}

}  // namespace
}  // namespace stairway::test
