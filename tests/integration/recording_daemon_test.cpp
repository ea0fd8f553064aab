// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>
#include <sched.h>
#include <sys/mount.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <filesystem>
#include <thread>

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

std::vector<std::string> recording_to(const std::string& folder, std::vector<std::string> more) {
  std::vector<std::string> arguments{"--set", "record.mode=continuous", "--set", "record.folder=" + folder,
                                     "--set", "record.min_free_mb=0",   "--set", "detector.voxel_mm=30"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return arguments;
}

std::vector<std::string> simulation(std::vector<std::string> more = {}) {
  std::vector<std::string> arguments{"--simulate=straight-flight", "--set", "simulate.speed=0", "--set",
                                     "disk.period_s=6"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return arguments;
}

std::filesystem::path first_file(const std::filesystem::path& folder) {
  std::error_code none;
  std::filesystem::path first;
  for (const auto& entry : std::filesystem::directory_iterator(folder, none))
    if (first.empty() || entry.path() < first) first = entry.path();
  return first;
}

std::vector<ipc::Bytes> answers_in(const std::filesystem::path& path) {
  std::vector<ipc::Bytes> answers;
  auto reader = ipc::EventLogReader::open(path);
  if (!reader) return answers;
  while (const auto event = reader->next()) {
    if (event->channel == kChannels.stairways) answers.emplace_back(event->bytes.begin(), event->bytes.end());
  }
  return answers;
}

template <class Condition>
bool comes_true(Condition condition) {
  const auto end = std::chrono::steady_clock::now() + kPatience;
  while (!condition()) {
    if (std::chrono::steady_clock::now() > end) return false;
    std::this_thread::sleep_for(20ms);
  }
  return true;
}

// Without a network: what is sent goes nowhere.
const std::vector<std::string> kUnheard{"--set", "lcm.url=memq://"};

TEST(RecordingDaemon, killed_while_recording_it_leaves_what_gives_the_same_answers_again) {
  const TemporaryFolder live, replayed;
  {
    DaemonProcess daemon(recording_to(live.path("r"), simulation(kUnheard)));
    ASSERT_TRUE(comes_true([&] { return answers_in(first_file(live.path("r"))).size() >= 2; }));
    daemon.signal(SIGKILL);
    ASSERT_EQ(daemon.wait(5s), -1);
  }
  const auto file = first_file(live.path("r"));
  // As if the power had gone while the last event was being written.
  std::filesystem::resize_file(file, std::filesystem::file_size(file) - 10);
  const auto answers = answers_in(file);
  ASSERT_GE(answers.size(), 1u);

  DaemonProcess daemon(
      recording_to(replayed.path("r"), {"--replay", file, "--set", "replay.speed=0", "--set", "lcm.url=memq://"}));
  EXPECT_EQ(daemon.wait(kPatience), 0);
  EXPECT_NE(daemon.output().find("a torn event, as after a crash or power loss"), std::string::npos) << daemon.output();
  const auto again = answers_in(first_file(replayed.path("r")));
  ASSERT_GE(again.size(), answers.size());
  for (std::size_t i = 0; i < answers.size(); ++i) EXPECT_EQ(again[i], answers[i]) << i;
}

TEST(RecordingDaemon, file_that_is_no_recording_is_refused) {
  const TemporaryFolder folder;
  write_text(folder.path("a.lcm"), "nothing of the kind");
  DaemonProcess daemon({"--replay", folder.path("a.lcm")});
  EXPECT_EQ(daemon.wait(kPatience), 1);
  EXPECT_NE(daemon.output().find("a.lcm: not a recording of stairwayd"), std::string::npos) << daemon.output();
}

TEST(RecordingDaemon, snapshot_is_written_on_request) {
  const TemporaryFolder folder;
  auto arguments = recording_to(folder.path("r"), simulation(kUnheard));
  arguments.insert(arguments.end(), {"--set", "record.mode=snapshot", "--set", "record.snapshot_sweeps=1"});
  DaemonProcess daemon(arguments);
  ASSERT_TRUE(daemon.has_said("stairway 1: ", kPatience));
  daemon.signal(SIGUSR2);
  ASSERT_TRUE(comes_true([&] { return !answers_in(first_file(folder.path("r"))).empty(); })) << daemon.output();
  EXPECT_TRUE(first_file(folder.path("r")).filename().string().starts_with("snapshot-"));
  daemon.signal(SIGTERM);
  EXPECT_EQ(daemon.wait(10s), 0);
}

// Seen by this process and its children alone, and gone with them.
bool mount_small_disk(const std::string& path) {
  return ::unshare(CLONE_NEWNS) == 0 && ::mount("none", "/", nullptr, MS_REC | MS_PRIVATE, nullptr) == 0 &&
         ::mount("tmpfs", path.c_str(), "tmpfs", 0, "size=1m") == 0;
}

TEST(RecordingDaemon, on_a_full_disk_detection_goes_on_and_health_says_so) {
  if (!has_private_network()) GTEST_SKIP() << "this kernel permits no network namespaces (unshare -n)";
  add_multicast_route();
  const TemporaryFolder folder;
  if (!mount_small_disk(folder.path())) GTEST_SKIP() << "needs root, to mount";
  Listener listener;
  DaemonProcess daemon(recording_to(folder.path(), simulation()));
  const auto is_told = [](const Listener& heard) {
    return !heard.healths.empty() && heard.healths.back().state.find("not recording: ") != std::string::npos &&
           heard.healths.back().state.find("No space left on device") != std::string::npos;
  };
  EXPECT_TRUE(listener.listen(kPatience, is_told)) << daemon.output();
  const std::size_t answers = listener.answers.size();
  EXPECT_TRUE(listener.listen(kPatience, [&](const Listener& heard) { return heard.answers.size() > answers + 1; }));
  const auto has_count = [](const Listener& heard) {
    for (const auto& [name, count] : heard.healths.back().drops)
      if (name == "unrecorded-messages" && count > 0) return true;
    return false;
  };
  EXPECT_TRUE(listener.listen(kPatience, has_count));
  daemon.signal(SIGTERM);
  EXPECT_EQ(daemon.wait(10s), 0);
  auto reader = ipc::EventLogReader::open(first_file(folder.path()));
  ASSERT_TRUE(reader);
  while (reader->next()) {
  }
  EXPECT_GT(reader->events(), 50u);
  EXPECT_EQ(describe(reader->damage()), "");
}

}  // namespace
}  // namespace stairway::test
