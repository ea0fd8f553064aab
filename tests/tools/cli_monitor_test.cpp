// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "ipc/channels.hpp"
#include "ipc/lcm_bus.hpp"
#include "ipc/message_codec.hpp"
#include "tests/ipc/message_fixtures.hpp"
#include "tests/tools/cli_process.hpp"
#include "tests/tools/temporary_folder.hpp"
#include "tools/stairway/daemon_news.hpp"

namespace stairway {
namespace {

using nlohmann::json;
using test::run_stairway;
using test::TemporaryFolder;

/// Messages in an LCM log, which the program plays instead of listening to the network.
class RecordedBus {
 public:
  RecordedBus() : path_(folder_.path("news.lcm")), bus_(*ipc::LcmBus::open("file://" + path_ + "?mode=w")) {}

  void send(const std::string& channel, const ipc::Bytes& bytes) { ASSERT_TRUE(bus_->publish(channel, bytes)); }

  test::Outcome monitor(std::vector<std::string> arguments) {
    bus_.reset();  // closes the log
    arguments.insert(arguments.begin(),
                     {"monitor", "--timeout", "10", "--set", "lcm.url=file://" + path_ + "?mode=r&speed=0"});
    return run_stairway(arguments);
  }

 private:
  TemporaryFolder folder_;
  std::string path_;
  std::unique_ptr<ipc::LcmBus> bus_;
};

const ipc::Channels kChannels;

ipc::Bytes nothing_found() {
  ipc::StairwaysMessage message;
  message.detection.rejected = {{"too-few-steps", "the best candidate shows 2 steps", {}}};
  return encode(message);
}

TEST(MonitorVerb, prints_every_answer_as_a_json_line) {
  RecordedBus bus;
  bus.send(kChannels.stairways, nothing_found());
  bus.send(kChannels.stairways, encode(ipc::test::sample_stairways()));
  const auto outcome = bus.monitor({"--format", "json"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  const std::size_t end = outcome.out.find('\n');
  const json first = json::parse(outcome.out.substr(0, end)), second = json::parse(outcome.out.substr(end));
  EXPECT_TRUE(first["stairways"].empty());
  EXPECT_EQ(first["rejected"][0]["reason"], "too-few-steps");
  EXPECT_EQ(second["sweep"], 7);
  EXPECT_EQ(second["utime"], 1'700'000'000'000'001);
  EXPECT_EQ(second["is_final"], false);
  EXPECT_EQ(second["stairways"][0]["track_id"], 42);
  EXPECT_NEAR(second["stairways"][0]["step_height"].get<double>(), 0.170123, 1e-9);
}

TEST(MonitorVerb, prints_every_answer_as_a_table_with_the_truth) {
  RecordedBus bus;
  bus.send(kChannels.stairways, encode(ipc::test::sample_stairways()));
  const auto outcome = bus.monitor({"--truth", "sim:straight-flight"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  for (const char* text : {"sweep 7 (preview): 2 stairways", "spiral", "truth", "not found", "2 found that the truth"})
    EXPECT_NE(outcome.out.find(text), std::string::npos) << outcome.out;
}

TEST(MonitorVerb, first_waits_for_a_stairway_and_then_ends) {
  RecordedBus bus;
  bus.send(kChannels.stairways, nothing_found());
  bus.send(kChannels.stairways, encode(ipc::test::sample_stairways()));
  bus.send(kChannels.stairways, encode(ipc::test::sample_stairways()));
  const auto outcome = bus.monitor({"--first", "--format", "json"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(std::count(outcome.out.begin(), outcome.out.end(), '\n'), 2);
}

TEST(MonitorVerb, first_fails_when_no_stairway_came) {
  RecordedBus bus;
  bus.send(kChannels.stairways, nothing_found());
  const auto outcome = bus.monitor({"--first"});
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_NE(outcome.err.find("no stairway"), std::string::npos) << outcome.err;
}

TEST(MonitorVerb, survives_and_counts_what_cannot_be_decoded) {
  RecordedBus bus;
  const ipc::Bytes good = encode(ipc::test::sample_stairways());
  bus.send(kChannels.stairways, {1, 2, 3});
  bus.send(kChannels.stairways, {good.begin(), good.end() - 5});
  bus.send(kChannels.health, good);
  bus.send(kChannels.stairways, good);
  const auto outcome = bus.monitor({"--format", "json"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(std::count(outcome.out.begin(), outcome.out.end(), '\n'), 1);
  EXPECT_NE(outcome.err.find("3 messages could not be decoded"), std::string::npos) << outcome.err;
}

TEST(MonitorVerb, tells_changes_of_the_daemon_once) {
  RecordedBus bus;
  for (const auto& [state, sweep] : {std::pair{"starting", 0}, {"scanning", 0}, {"scanning", 0}, {"scanning", 1}}) {
    ipc::HealthMessage health;
    health.state = state;
    health.sweep = sweep;
    bus.send(kChannels.health, encode(health));
  }
  const auto outcome = bus.monitor({});
  EXPECT_EQ(outcome.exit_code, 1) << "no answer came";
  std::size_t lines = 0;
  for (std::size_t at = 0; (at = outcome.err.find("sweep ", at)) != std::string::npos; ++at) ++lines;
  EXPECT_EQ(lines, 3U) << outcome.err;
}

TEST(MonitorVerb, waits_for_a_network_without_multicast_route_until_the_time_is_up) {
  const std::string command = "unshare -n " STAIRWAY " monitor --timeout 1 2>&1 >/dev/null";
  if (std::system("unshare -n true 2>/dev/null") != 0) GTEST_SKIP() << "no network namespaces here";
  const TemporaryFolder folder;
  const int status = std::system((command + " | cat >" + folder.path("err")).c_str());
  ASSERT_EQ(WEXITSTATUS(status), 0);
  const std::string err = test::read_text(folder.path("err"));
  EXPECT_NE(err.find("ip route add 224.0.0.0/4 dev lo; trying again"), std::string::npos) << err;
  EXPECT_NE(err.find("is stairwayd running"), std::string::npos) << err;
}

TEST(HealthText, names_devices_that_are_silent_and_the_quality_of_the_clock) {
  ipc::HealthMessage health;
  health.devices = {{"scanner", "streaming", "", true, 40.0, 0.1, 0},
                    {"encoder", "no chip", "disconnected", false, 0.0, 7.2, 3}};
  health.clock = {.period_ms = 25.02, .delay_ms = 0.71, .resets = 2};
  const std::string text = tools::health_text(health);
  EXPECT_NE(text.find("encoder silent for 7 s"), std::string::npos) << text;
  EXPECT_EQ(text.find("scanner silent"), std::string::npos) << text;
  EXPECT_NE(text.find("clock 25.02 ms late 0.7 ms set 2 times"), std::string::npos) << text;
}

TEST(HealthText, bar_shows_the_share_of_the_sweep_whatever_the_message_says) {
  ipc::HealthMessage health;
  health.state = "scanning";
  const std::pair<double, std::string> table[] = {
      {0.0, "[....................]   0 %"},  {0.5, "[##########..........]  50 %"},
      {1.0, "[####################] 100 %"},  {7.0, "[####################] 100 %"},
      {-1.0, "[....................]   0 %"}, {std::nan(""), "[....................]   0 %"}};
  for (const auto& [progress, bar] : table) {
    health.sweep_progress = progress;
    EXPECT_NE(tools::health_text(health).find(bar), std::string::npos) << tools::health_text(health);
  }
}

}  // namespace
}  // namespace stairway
