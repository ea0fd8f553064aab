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
#include "tools/stairway/monitor_screen.hpp"
#include "tools/stairway/screen_text.hpp"

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

  /// What the program writes to a terminal.
  std::string monitor_on_a_terminal(int exit_code) {
    bus_.reset();
    const std::string command = STAIRWAY " monitor --timeout 10 --set 'lcm.url=file://" + path_ + "?mode=r&speed=0'";
    const std::string typescript = folder_.path("typescript");
    const int status =
        std::system(("TERM=xterm script -qec \"" + command + "\" " + typescript + " </dev/null >/dev/null").c_str());
    EXPECT_EQ(WEXITSTATUS(status), exit_code);
    return test::read_text(typescript);
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

TEST(MonitorVerb, prints_health_as_json_lines_with_their_channel) {
  RecordedBus bus;
  bus.send(kChannels.health, encode(ipc::test::kHealth));
  bus.send(kChannels.stairways, nothing_found());
  const auto outcome = bus.monitor({"--format", "json"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  const std::size_t end = outcome.out.find('\n');
  const json health = json::parse(outcome.out.substr(0, end)), answer = json::parse(outcome.out.substr(end));
  EXPECT_EQ(health["channel"], "STAIRWAY_HEALTH");
  EXPECT_EQ(health["reasons"], json::parse(R"(["encoder:disconnected", "not-recording"])"));
  EXPECT_EQ(health["devices"][1]["reason"], "disconnected");
  EXPECT_TRUE(health["devices"][1]["age_s"].is_null());
  EXPECT_EQ(health["stages"][1]["p95_ms"], 950.5);
  EXPECT_EQ(health["clock"]["bound_ms"], 0.45);
  EXPECT_EQ(health["last"]["stairway_sweep"], 2);
  EXPECT_EQ(answer["channel"], "STAIRWAY_STAIRWAYS");
}

TEST(MonitorVerb, prints_every_answer_as_a_table_with_the_truth) {
  RecordedBus bus;
  bus.send(kChannels.stairways, encode(ipc::test::sample_stairways()));
  const auto outcome = bus.monitor({"--truth", "sim:straight-flight"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  for (const char* text : {"sweep 7 (preview): 2 stairways", "spiral", "truth", "not found", "2 found that the truth"})
    EXPECT_NE(outcome.out.find(text), std::string::npos) << outcome.out;
}

TEST(MonitorVerb, line_after_line_a_preview_is_printed_when_it_shows_something_new) {
  RecordedBus bus;
  ipc::StairwaysMessage message = ipc::test::sample_stairways();
  message.track_ids = {1, 2};
  for (int i = 0; i < 3; ++i) bus.send(kChannels.stairways, encode(message));
  message.track_ids = {1, 3};
  bus.send(kChannels.stairways, encode(message));
  message.is_final = true;
  bus.send(kChannels.stairways, encode(message));
  message.is_final = false;
  bus.send(kChannels.stairways, encode(message));
  const std::string out = bus.monitor({"--lines"}).out;
  const auto count = [&](const std::string& text) {
    int number = 0;
    for (std::size_t at = out.find(text); at != std::string::npos; at = out.find(text, at + 1)) ++number;
    return number;
  };
  EXPECT_EQ(count("sweep 7 (preview): 2 stairways"), 2) << out;
  EXPECT_EQ(count("sweep 7: 2 stairways"), 1) << out;
}

TEST(MonitorVerb, fills_a_terminal_and_leaves_it_as_it_was) {
  RecordedBus bus;
  bus.send(kChannels.health, encode(ipc::test::kHealth));
  bus.send(kChannels.stairways, encode(ipc::test::sample_stairways()));
  const std::string shown = bus.monitor_on_a_terminal(0);
  const std::size_t enter = shown.find("\033[?1049h"), state = shown.find("encoder:disconnected, not-recording");
  const std::size_t stairs = shown.find("spiral"), leave = shown.find("\033[?1049l");
  EXPECT_LT(enter, state) << shown;
  EXPECT_LT(state, stairs) << shown;
  EXPECT_LT(stairs, leave) << shown;
  EXPECT_NE(leave, std::string::npos) << shown;
}

TEST(MonitorVerb, terminal_without_an_answer_is_a_failure) {
  RecordedBus bus;
  bus.send(kChannels.health, encode(ipc::test::kHealth));
  const std::string shown = bus.monitor_on_a_terminal(1);
  EXPECT_LT(shown.find("\033[?1049l"), shown.find("no answer from file://")) << shown;
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

tools::MonitorView busy_view() {
  tools::MonitorView view{.place = "udpm://239.255.76.67:7667", .time = "14:03:12", .health = ipc::test::kHealth};
  view.answer = ipc::test::sample_stairways();
  for (const char* stage : {"voxel_grid", "normals", "segmentation", "plane_finder", "stair_graph", "fit", "railing"})
    view.health->stages.push_back({stage, 10.0, 20.0});
  view.health->devices[1].state =
      "no such chip: is the name in encoder.chip one that gpiodetect shows on this computer?";
  for (const char* reason : {"too-near", "invalid", "unseen-sweeps"}) view.health->drops.emplace_back(reason, 5);
  return view;
}

std::string page(const tools::MonitorView& view, std::size_t columns, std::size_t rows) {
  std::string text;
  for (const tools::ScreenLine& line : tools::monitor_lines(view, columns, rows)) text += line.text + '\n';
  return text;
}

TEST(MonitorScreen, fits_every_size_of_terminal) {
  for (const std::size_t columns : {1, 20, 40, 60, 76, 80, 132, 300}) {
    for (const std::size_t rows : {1, 5, 10, 16, 25, 60}) {
      const auto lines = tools::monitor_lines(busy_view(), columns, rows);
      EXPECT_LE(lines.size(), rows);
      for (const tools::ScreenLine& line : lines) EXPECT_LE(line.text.size(), columns) << line.text;
    }
  }
}

TEST(MonitorScreen, usual_terminal_shows_everything_that_matters) {
  const std::string text = page(busy_view(), 80, 25);
  for (const char* part : {"stairwayd: encoder:disconnected, not-recording", "14:03:12", " 25 %", "1513400 points",
                           "a third of the turn is missing", "streaming", "40.0 /s", "no such chip", "clock: tm",
                           "bound 0.45 ms", "total", "950", "unseen-sweeps", "of sweep 7 (preview)", "spiral", "170.1"})
    EXPECT_NE(text.find(part), std::string::npos) << part << '\n' << text;
}

TEST(MonitorScreen, troubles_come_before_what_every_sweep_has) {
  const std::string text = page(busy_view(), 80, 25);
  EXPECT_LT(text.find("unseen-sweeps"), text.find("no-return")) << text;
}

TEST(MonitorScreen, small_terminal_keeps_devices_and_stairways) {
  const std::string text = page(busy_view(), 60, 14);
  EXPECT_NE(text.find("streaming"), std::string::npos) << text;
  EXPECT_NE(text.find("spiral"), std::string::npos) << text;
}

TEST(MonitorScreen, state_is_told_and_silence) {
  tools::MonitorView view = busy_view();
  view.health_age_s = 12.0;
  EXPECT_EQ(page(view, 80, 25).find("stairwayd: SILENT for 12 s; it said: scanning"), 0U);
  view.health_age_s = 0.0;
  view.health->reasons = {"encoder:disconnected"};
  view.health->state = "encoder: no such chip";
  EXPECT_EQ(page(view, 80, 25).find("stairwayd: encoder: no such chip "), 0U);
  view.health->reasons.push_back("not-recording");
  EXPECT_EQ(page(view, 80, 25).find("stairwayd: encoder:disconnected, not-recording "), 0U);
  EXPECT_EQ(page({.place = "udpm://x", .time = "now", .note = "cannot open LCM: try this"}, 16, 25),
            "stairwayd: nothi\nlistening to udp\ncannot open LCM:\ntry this\n");
}

TEST(ScreenText, cannot_steer_the_terminal_and_counts_characters) {
  EXPECT_EQ(tools::clipped("a\033[2Jb\n", 80), "a [2Jb ");
  EXPECT_EQ(tools::clipped("\u00e4\u00f6\u00fc", 2), "\u00e4\u00f6");
  EXPECT_EQ(tools::padded("\u00e4", 3), "\u00e4  ");
  EXPECT_EQ(tools::wrapped("one two three", 7, 3), (std::vector<std::string>{"one two", "three"}));
  EXPECT_EQ(tools::wrapped("one two three", 7, 1), std::vector<std::string>{"one two"});
  EXPECT_EQ(tools::wrapped("onetwothree", 4, 9), (std::vector<std::string>{"onet", "woth", "ree"}));
  EXPECT_EQ(tools::wrapped("", 4, 9), std::vector<std::string>{""});
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
