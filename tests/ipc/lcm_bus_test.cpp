// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "ipc/lcm_bus.hpp"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "ipc/channels.hpp"
#include "ipc/message_codec.hpp"

namespace stairway::ipc {
namespace {

using namespace std::chrono_literals;

TEST(LcmBus, delivers_within_the_process) {
  const auto bus = LcmBus::open("memq://");
  ASSERT_TRUE(bus) << bus.error().text;
  std::vector<std::string> texts;
  const auto keep = [&](const BusMessage& message) {
    texts.push_back(std::string(message.channel) + ":" + std::string(message.bytes.begin(), message.bytes.end()));
  };
  ASSERT_TRUE((*bus)->subscribe("STAIRWAY_.*", keep));
  EXPECT_FALSE((*bus)->handle(0ms).value());
  const Bytes bytes{'a', 'b'};
  ASSERT_TRUE((*bus)->publish("STAIRWAY_SCAN", bytes));
  ASSERT_TRUE((*bus)->publish("OTHER", bytes));
  EXPECT_TRUE((*bus)->handle(1000ms).value());
  while ((*bus)->handle(0ms).value()) {
  }
  EXPECT_EQ(texts, std::vector<std::string>{"STAIRWAY_SCAN:ab"});
}

TEST(LcmBus, log_file_plays_back_what_was_written_and_then_ends) {
  const auto path = std::filesystem::temp_directory_path() / (std::to_string(::getpid()) + "_bus.lcm");
  {
    const auto log = LcmBus::open("file://" + path.string() + "?mode=w");
    ASSERT_TRUE(log) << log.error().text;
    for (int i = 0; i < 3; ++i) {
      ASSERT_TRUE((*log)->publish(Channels().health, encode(HealthMessage{.utime_us = i})));
    }
  }
  const auto log = LcmBus::open("file://" + path.string() + "?mode=r&speed=0");
  ASSERT_TRUE(log) << log.error().text;
  std::vector<std::int64_t> utimes;
  ASSERT_TRUE((*log)->subscribe(Channels().health, [&](const BusMessage& message) {
    utimes.push_back(decode<HealthMessage>(message.bytes).value().utime_us);
    EXPECT_GT(message.arrival_utime_us, 0);
  }));
  tl::expected<bool, BusError> handled = true;
  for (int i = 0; i < 10 && handled; ++i) handled = (*log)->handle(1000ms);
  ASSERT_FALSE(handled);
  EXPECT_EQ(handled.error().fault, BusFault::Ended);
  EXPECT_EQ(utimes, (std::vector<std::int64_t>{0, 1, 2}));
  std::filesystem::remove(path);
}

TEST(LcmBus, url_that_cannot_be_opened_says_what_to_do) {
  const auto missing = LcmBus::open("file:///nonexistent/run.lcm?mode=r");
  ASSERT_FALSE(missing);
  EXPECT_EQ(
      missing.error().text,
      "cannot open LCM at 'file:///nonexistent/run.lcm?mode=r': does the log file exist, and may this user open it?");
  const auto unknown = LcmBus::open("carrier-pigeon://");
  ASSERT_FALSE(unknown);
  EXPECT_NE(unknown.error().text.find("expected udpm://"), std::string::npos) << unknown.error().text;
}

TEST(LcmBus, refuses_channel_names_that_lcm_cannot_carry) {
  const auto bus = LcmBus::open("memq://");
  ASSERT_TRUE(bus);
  EXPECT_TRUE((*bus)->publish(std::string(63, 'C'), {}));
  EXPECT_EQ((*bus)->publish(std::string(64, 'C'), {}).error().fault, BusFault::BadChannel);
  EXPECT_EQ((*bus)->publish("", {}).error().fault, BusFault::BadChannel);
}

TEST(BusOptions, problem_names_the_key) {
  EXPECT_EQ(BusOptions{}.problem(), "");
  EXPECT_NE((BusOptions{"239.255.76.67:7667", "A_"}.problem().find("url")), std::string::npos);
  EXPECT_NE((BusOptions{"memq://", "A.*"}.problem().find("channel_prefix")), std::string::npos);
  EXPECT_NE((BusOptions{"memq://", std::string(49, 'A')}.problem().find("channel_prefix")), std::string::npos);
  EXPECT_EQ(Channels("ROBOT1/").scan, "ROBOT1/SCAN");
}

/// Runs `script` where no packet can reach a real interface; its exit code, or nothing if the kernel refuses
/// namespaces.
std::optional<int> run_without_network(const std::string& script) {
  const std::string unshare = ::geteuid() == 0 ? "unshare -n" : "unshare -rn";
  if (std::system((unshare + " true 2>/dev/null").c_str()) != 0) return std::nullopt;
  return WEXITSTATUS(std::system((unshare + " sh -c '" + script + "'").c_str()));
}

TEST(LcmBus, multicast_carries_a_scan_between_two_buses) {
  const auto exit_code = run_without_network(
      "ip link set lo up multicast on && ip route add 224.0.0.0/4 dev lo && exec " STAIRWAY_MULTICAST_PROBE " deliver");
  if (!exit_code) GTEST_SKIP() << "no network namespaces here";
  EXPECT_EQ(*exit_code, 0);
}

TEST(LcmBus, missing_multicast_route_is_an_error_with_the_remedy) {
  const auto exit_code = run_without_network("exec " STAIRWAY_MULTICAST_PROBE " refuse 2>/dev/null");
  if (!exit_code) GTEST_SKIP() << "no network namespaces here";
  EXPECT_EQ(*exit_code, 0);
}

}  // namespace
}  // namespace stairway::ipc
