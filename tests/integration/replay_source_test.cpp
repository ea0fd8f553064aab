// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "tools/stairwayd/replay_source.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <mutex>
#include <thread>

#include "config/load_settings.hpp"
#include "ipc/message_codec.hpp"
#include "ipc/recording/recorder.hpp"
#include "tests/tools/recording_fixture.hpp"
#include "tests/tools/temporary_folder.hpp"
#include "tools/recording/recorded_previews.hpp"
#include "tools/recording/recorded_settings.hpp"
#include "tools/stairwayd/pipeline.hpp"
#include "tools/stairwayd/simulated_source.hpp"

namespace stairway::daemon {
namespace {

using namespace std::chrono_literals;
using test::TemporaryFolder;

const ipc::Channels kChannels;

template <class Condition>
bool comes_true(Condition condition) {
  const auto end = std::chrono::steady_clock::now() + 200s;
  while (!condition()) {
    if (std::chrono::steady_clock::now() > end) return false;
    std::this_thread::sleep_for(2ms);
  }
  return true;
}

/// Keeps the answers, previews among them, and the scans that were sent.
class Sent {
 public:
  void add(const std::string& channel, std::span<const std::uint8_t> bytes) {
    if (channel != kChannels.stairways && channel != kChannels.scan) return;
    const std::lock_guard lock(mutex_);
    (channel == kChannels.stairways ? answers : scans).emplace_back(bytes.begin(), bytes.end());
    if (channel == kChannels.stairways && ipc::decode<ipc::StairwaysMessage>(bytes)->is_final) ++final_answers_;
  }
  std::size_t answer_count() {
    const std::lock_guard lock(mutex_);
    return answers.size();
  }
  std::size_t final_answer_count() {
    const std::lock_guard lock(mutex_);
    return final_answers_;
  }

  std::vector<ipc::Bytes> answers;
  std::vector<ipc::Bytes> scans;

 private:
  std::mutex mutex_;
  std::size_t final_answers_ = 0;
};

std::unique_ptr<ReplaySource> open_replay(const std::filesystem::path& path, double speed = 0.0,
                                          std::optional<std::vector<std::int64_t>> previews = {}) {
  const auto facts = tools::examine_recording(path);
  if (!facts) {
    ADD_FAILURE() << facts.error().text;
    return nullptr;
  }
  return ReplaySource::open(path, *facts, speed, std::move(previews)).value();
}

// A turn in six seconds and coarse voxels, so that the passes are quick.
config::Settings quick_settings() {
  config::Settings settings;
  settings.simulate.speed = 0.0;
  settings.disk.period_s = 6.0;
  settings.detector.voxel_m = 0.0301;
  return settings;
}

// Runs the simulated robot until it has given this many final answers, and records it.
std::filesystem::path record_run(const TemporaryFolder& folder, std::size_t answers, Sent& sent,
                                 const config::Settings& settings = quick_settings()) {
  ipc::RecordOptions options;
  options.mode = ipc::RecordMode::Continuous;
  options.folder = folder.path();
  options.min_free_mb = 0;
  ipc::Recorder recorder(options, kChannels);
  const auto publish = [&](const std::string& channel, std::span<const std::uint8_t> bytes) {
    sent.add(channel, bytes);
    recorder.add(channel, bytes, 1'700'000'000'000'000);
    return true;
  };
  Pipeline pipeline(settings, std::make_unique<SimulatedSource>(settings, 1'700'000'000'000'000), publish);
  pipeline.report();
  EXPECT_TRUE(comes_true([&] { return sent.final_answer_count() >= answers; }));
  pipeline.stop();
  recorder.close();
  EXPECT_EQ(recorder.status().lost_events, 0u);
  return recorder.status().file;
}

TEST(Replay, gives_the_answers_and_scans_of_the_run_to_the_last_byte) {
  const TemporaryFolder folder;
  Sent live, replayed;
  const auto file = record_run(folder, 2, live);

  const auto facts = tools::examine_recording(file);
  ASSERT_TRUE(facts) << facts.error().text;
  ASSERT_TRUE(facts->settings);
  const auto settings = config::load_settings({{}, tools::recorded_settings(facts->settings->toml).assignments});
  ASSERT_TRUE(settings) << settings.error().text;
  const auto publish = [&](const std::string& channel, std::span<const std::uint8_t> bytes) {
    replayed.add(channel, bytes);
    return true;
  };
  Pipeline pipeline(settings->settings, open_replay(file), publish);
  EXPECT_TRUE(comes_true([&] { return replayed.answer_count() >= live.answers.size(); }));
  pipeline.stop();
  for (std::size_t i = 0; i < live.answers.size(); ++i) EXPECT_EQ(replayed.answers[i], live.answers[i]) << i;
  EXPECT_GT(live.answers.size(), live.final_answer_count()) << "no preview";
  EXPECT_FALSE(ipc::decode<ipc::StairwaysMessage>(live.answers[0])->detection.stairways.empty());
  ASSERT_GT(replayed.scans.size(), 400u);
  const std::size_t common = std::min(live.scans.size(), replayed.scans.size());
  EXPECT_GE(common + 20, live.scans.size());
  EXPECT_TRUE(
      std::equal(live.scans.begin(), live.scans.begin() + static_cast<std::ptrdiff_t>(common), replayed.scans.begin()));
}

TEST(Replay, has_the_previews_where_the_run_made_them) {
  const TemporaryFolder folder;
  Sent live, replayed;
  config::Settings settings = quick_settings();
  settings.preview.every_s = 0.7;
  const auto file = record_run(folder, 1, live, settings);
  ASSERT_GT(live.answers.size(), live.final_answer_count()) << "no preview";
  const auto previews = tools::recorded_previews(file, "STAIRWAY_");
  ASSERT_TRUE(previews);
  EXPECT_EQ(previews->size(), live.answers.size() - live.final_answer_count());
  // At other times if it were to decide by itself.
  settings.preview.every_s = 0.37;
  const auto publish = [&](const std::string& channel, std::span<const std::uint8_t> bytes) {
    replayed.add(channel, bytes);
    return true;
  };
  Pipeline pipeline(settings, open_replay(file, 0.0, previews), publish);
  EXPECT_TRUE(comes_true([&] { return replayed.answer_count() >= live.answers.size(); }));
  pipeline.stop();
  for (std::size_t i = 0; i < live.answers.size(); ++i) EXPECT_EQ(replayed.answers[i], live.answers[i]) << i;
}

TEST(Replay, answers_every_sweep_and_then_ends) {
  const TemporaryFolder folder;
  test::write_fixture(folder.path() / "a.lcm", {.scans = 40 * 6 + 5});
  std::atomic<int> passes = 0;
  const auto publish = [](const std::string&, std::span<const std::uint8_t>) { return true; };
  Pipeline pipeline({}, open_replay(folder.path() / "a.lcm"), publish, [&](const Pass&) {
    std::this_thread::sleep_for(10ms);  // slower than the source
    ++passes;
  });
  EXPECT_TRUE(comes_true([&] { return pipeline.has_ended(); }));
  EXPECT_EQ(passes, 6);
  EXPECT_TRUE(pipeline.stop());
}

TEST(Replay, plays_in_the_time_of_the_recording) {
  const TemporaryFolder folder;
  test::write_fixture(folder.path() / "a.lcm", {.scans = 10});
  const auto source = open_replay(folder.path() / "a.lcm", 2.5);
  const auto begin = std::chrono::steady_clock::now();
  std::size_t scans = 0;
  while (!source->has_ended()) {
    for (const SourceEvent& event : source->read(5ms)) scans += std::holds_alternative<drivers::LaserScan>(event);
  }
  EXPECT_EQ(scans, 10u);
  EXPECT_GE(std::chrono::steady_clock::now() - begin, 9 * 10ms);
}

TEST(Replay, damage_is_told_as_a_trouble) {
  const TemporaryFolder folder;
  test::write_fixture(folder.path() / "a.lcm", {.scans = 10});
  std::filesystem::resize_file(folder.path() / "a.lcm", std::filesystem::file_size(folder.path() / "a.lcm") - 50);
  const auto source = open_replay(folder.path() / "a.lcm");
  std::vector<std::string> troubles;
  while (!source->has_ended()) {
    for (const SourceEvent& event : source->read(5ms))
      if (const auto* trouble = std::get_if<SourceTrouble>(&event)) troubles.push_back(trouble->detail);
  }
  ASSERT_EQ(troubles.size(), 1u);
  EXPECT_NE(troubles.front().find("torn"), std::string::npos) << troubles.front();
}

}  // namespace
}  // namespace stairway::daemon
