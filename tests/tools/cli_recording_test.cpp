// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <sstream>

#include "ipc/cloud_file.hpp"
#include "ipc/recording/event_log_reader.hpp"
#include "tests/tools/cli_process.hpp"
#include "tests/tools/recording_fixture.hpp"
#include "tests/tools/temporary_folder.hpp"

namespace stairway {
namespace {

using nlohmann::json;
using test::run_stairway;

class RecordingVerbs : public testing::Test {
 protected:
  void SetUp() override { test::write_fixture(recording); }

  std::vector<std::string> lines_of(const std::string& name) const {
    std::istringstream text(test::read_text(folder.path(name)));
    std::vector<std::string> lines;
    for (std::string line; std::getline(text, line);) lines.push_back(line);
    return lines;
  }
  void tear(std::size_t bytes) const {
    std::filesystem::resize_file(recording, std::filesystem::file_size(recording) - bytes);
  }

  test::TemporaryFolder folder;
  std::string recording = folder.path("rec.lcm");
};

TEST_F(RecordingVerbs, detect_answers_for_every_sweep_with_the_recorded_settings) {
  const auto outcome = run_stairway({"detect", "--format", "json", recording});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  const json answer = json::parse(outcome.out);
  EXPECT_EQ(answer["source"], recording);
  EXPECT_EQ(answer["points"], 4000);
  EXPECT_TRUE(answer["stairways"].empty());
  EXPECT_FALSE(answer["rejected"].empty());
  EXPECT_NE(outcome.err.find("no setting detector.long_gone"), std::string::npos) << outcome.err;
}

TEST_F(RecordingVerbs, detect_without_that_sweep_fails) {
  const auto outcome = run_stairway({"detect", "--sweep", "5", recording});
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_NE(outcome.err.find("no sweep 5"), std::string::npos) << outcome.err;
}

TEST_F(RecordingVerbs, torn_recording_is_used_up_to_the_tear_with_a_warning) {
  tear(100);
  for (const char* verb : {"detect", "info"}) {
    const auto outcome = run_stairway({verb, recording});
    EXPECT_EQ(outcome.exit_code, 0);
    EXPECT_NE((outcome.out + outcome.err).find("a torn event, as after a crash or power loss"), std::string::npos)
        << outcome.out << outcome.err;
  }
}

TEST_F(RecordingVerbs, info_counts_what_is_in_it) {
  const auto outcome = run_stairway({"info", "--format", "json", recording});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const json info = json::parse(outcome.out);
  EXPECT_EQ(info["messages"], 1 + 2 * 45 + 1);
  EXPECT_EQ(info["channels"]["STAIRWAY_SCAN"]["messages"], 45);
  EXPECT_NEAR(info["channels"]["STAIRWAY_SCAN"]["rate"], 40.0, 0.1);
  EXPECT_NEAR(info["duration"], 1.1, 0.05);
  EXPECT_NEAR(info["turns"], 45.0 / 40.0, 1e-3);
  EXPECT_EQ(info["answers"], 1);
  EXPECT_EQ(info["previews"], 0);
  EXPECT_EQ(info["stairways"], 1);
  EXPECT_EQ(info["lost_scans"], 0);
  EXPECT_EQ(info["versions"], json::array({"1.2.3"}));
  EXPECT_EQ(info["damage"]["torn_bytes"], 0);
}

TEST_F(RecordingVerbs, info_refuses_what_is_no_log) {
  test::write_text(folder.path("other.lcm"), "nothing of the kind");
  const auto outcome = run_stairway({"info", folder.path("other.lcm"), recording});
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_NE(outcome.err.find("other.lcm: it holds no LCM event"), std::string::npos) << outcome.err;
  EXPECT_NE(outcome.out.find("rec.lcm: 1.1 s, 92 messages"), std::string::npos) << outcome.out;
}

TEST_F(RecordingVerbs, convert_writes_a_sweep_as_a_cloud) {
  for (const std::string name : {"sweep.pcd", "sweep.ply"}) {
    const auto outcome = run_stairway({"convert", recording, "-o", folder.path(name), "--labels"});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    const auto cloud = ipc::read_cloud_file(folder.path(name));
    ASSERT_TRUE(cloud) << cloud.error().text;
    EXPECT_EQ(cloud->cloud.points.size(), 4000u);
  }
  ASSERT_EQ(run_stairway({"convert", folder.path("sweep.pcd"), "-o", folder.path("a.csv")}).exit_code, 0);
  EXPECT_EQ(lines_of("a.csv").size(), 4001u);
  EXPECT_EQ(lines_of("a.csv").front(), "x_m,y_m,z_m");
  ASSERT_EQ(run_stairway({"convert", folder.path("sweep.pcd"), "--labels", "-o", folder.path("a.json")}).exit_code, 0);
  const json points = json::parse(test::read_text(folder.path("a.json")));
  EXPECT_EQ(points["points"].size(), 4000u);
  EXPECT_EQ(points["labels"].size(), 4000u);
}

TEST_F(RecordingVerbs, convert_writes_messages_as_tables) {
  const auto convert = [&](const std::string& what, const std::string& name) {
    return run_stairway({"convert", recording, "--what", what, "-o", folder.path(name)});
  };
  EXPECT_EQ(convert("scans", "scans.csv").exit_code, 0);
  const auto scans = lines_of("scans.csv");
  ASSERT_EQ(scans.size(), 1u + 4500);
  EXPECT_EQ(std::ranges::count(scans[0], ','), std::ranges::count(scans[1], ','));
  EXPECT_EQ(scans[2], "1700000000000000,0,1,240000,-0.49,0.00150796447,3,ok,");
  EXPECT_EQ(convert("angles", "angles.csv").exit_code, 0);
  EXPECT_EQ(lines_of("angles.csv").size(), 1u + 46);
  EXPECT_EQ(convert("stairways", "stairs.csv").exit_code, 0);
  const auto stairs = lines_of("stairs.csv");
  ASSERT_EQ(stairs.size(), 2u);
  EXPECT_EQ(std::ranges::count(stairs[0], ','), std::ranges::count(stairs[1], ','));
  EXPECT_EQ(run_stairway({"convert", recording, "-o", folder.path("stairs.json")}).exit_code, 0);
  EXPECT_EQ(json::parse(lines_of("stairs.json").front())["stairways"][0]["track_id"], 7);
  EXPECT_EQ(convert("scans", "scans.json").exit_code, 0);
  EXPECT_EQ(json::parse(lines_of("scans.json").back())["sequence"], 44);

  const auto none = convert("health", "health.csv");
  EXPECT_EQ(none.exit_code, 1);
  EXPECT_NE(none.err.find("HEALTH"), std::string::npos) << none.err;
  EXPECT_EQ(convert("scans", "scans.ply").exit_code, 2);
}

std::vector<ipc::StoredEvent> events_of(const std::filesystem::path& path) {
  std::vector<ipc::StoredEvent> events;
  auto reader = ipc::EventLogReader::open(path);
  if (!reader) return events;
  while (const auto event = reader->next())
    events.push_back({0, std::string(event->channel), {event->bytes.begin(), event->bytes.end()}});
  return events;
}

bool are_equal(const std::vector<ipc::StoredEvent>& a, const std::vector<ipc::StoredEvent>& b) {
  return std::ranges::equal(a, b, [](const ipc::StoredEvent& x, const ipc::StoredEvent& y) {
    return x.channel == y.channel && x.bytes == y.bytes;
  });
}

TEST_F(RecordingVerbs, replay_sends_every_message_as_it_was) {
  const std::string sent = folder.path("sent.lcm");
  const auto outcome =
      run_stairway({"replay", recording, "--rate", "0", "--set", "lcm.url=file://" + sent + "?mode=w"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(outcome.out, "92 messages sent\n");
  EXPECT_TRUE(are_equal(events_of(sent), events_of(recording)));
}

TEST_F(RecordingVerbs, replay_can_begin_later_and_keep_to_some_channels) {
  const std::string sent = folder.path("sent.lcm");
  const auto outcome = run_stairway({"replay", recording, "--rate", "0", "--from", "1", "--channels",
                                     "STAIRWAY_(SCAN|SETTINGS)", "--set", "lcm.url=file://" + sent + "?mode=w"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  const auto events = events_of(sent);
  ASSERT_EQ(events.size(), 6u);
  EXPECT_EQ(events.front().channel, "STAIRWAY_SETTINGS") << "it is needed to understand the rest";
}

TEST_F(RecordingVerbs, replay_of_a_torn_file_says_so) {
  tear(5);
  const auto outcome = run_stairway({"replay", recording, "--rate", "0", "--set", "lcm.url=memq://"});
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_EQ(outcome.out, "91 messages sent\n");
  EXPECT_NE(outcome.err.find("torn"), std::string::npos);
}

TEST_F(RecordingVerbs, replay_that_nobody_can_start_is_wrong_usage) {
  const auto outcome = run_stairway({"replay", recording, "--paused", "--set", "lcm.url=memq://"});
  EXPECT_EQ(outcome.exit_code, 2) << outcome.out;
  EXPECT_EQ(run_stairway({"replay", recording, "--channels", "("}).exit_code, 2);
  EXPECT_EQ(run_stairway({"replay", folder.path("none.lcm"), "--set", "lcm.url=memq://"}).exit_code, 1);
}

std::string recorded_file(const std::filesystem::path& path) {
  for (const auto& entry : std::filesystem::directory_iterator(path)) return entry.path();
  return {};
}

TEST_F(RecordingVerbs, record_writes_what_it_hears) {
  const std::string out = folder.path("out");
  const auto outcome = run_stairway({"record", "--folder", out, "--set", "record.min_free_mb=0", "--set",
                                     "lcm.url=file://" + recording + "?mode=r&speed=0"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(outcome.out.find("92 messages, "), 0u) << outcome.out;
  EXPECT_TRUE(are_equal(events_of(recorded_file(out)), events_of(recording)));
}

TEST_F(RecordingVerbs, snapshot_is_written_at_the_end) {
  const std::string out = folder.path("out");
  const auto outcome = run_stairway({"record", "--snapshot", "2", "--folder", out, "--set", "record.min_free_mb=0",
                                     "--set", "lcm.url=file://" + recording + "?mode=r&speed=0"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("1 snapshots written"), std::string::npos) << outcome.out;
  EXPECT_NE(recorded_file(out).find("snapshot-000001-"), std::string::npos);
}

TEST_F(RecordingVerbs, record_that_hears_nothing_fails_and_says_what_to_look_at) {
  const auto outcome =
      run_stairway({"record", "--folder", folder.path("out"), "--duration", "0.2", "--set", "lcm.url=memq://"});
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_NE(outcome.err.find("is stairwayd running"), std::string::npos) << outcome.err;
  EXPECT_FALSE(std::filesystem::exists(folder.path("out")));
}

}  // namespace
}  // namespace stairway
