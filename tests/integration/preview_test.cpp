// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <map>
#include <mutex>
#include <thread>
#include <vector>

#include "ipc/message_codec.hpp"
#include "tools/stairwayd/pipeline.hpp"
#include "tools/stairwayd/simulated_source.hpp"

namespace stairway::daemon {
namespace {

using namespace std::chrono_literals;

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

/// The messages of STAIRWAY_STAIRWAYS, and the passes that made them and others.
struct Course {
  std::vector<ipc::Bytes> sent;
  std::vector<Pass> passes;

  std::vector<ipc::StairwaysMessage> messages() const {
    std::vector<ipc::StairwaysMessage> all;
    for (const ipc::Bytes& bytes : sent) all.push_back(ipc::decode<ipc::StairwaysMessage>(bytes).value());
    return all;
  }
};

/// A turn in six seconds, and coarse voxels, so that the passes are quick.
config::Settings quick_settings(const std::string& scene) {
  config::Settings settings;
  settings.simulate.scene = scene;
  settings.simulate.speed = 0.0;
  settings.disk.period_s = 6.0;
  settings.detector.voxel_m = 0.03;
  settings.preview.every_s = 0.5;
  return settings;
}

/// Runs the simulated robot until it has answered so many whole sweeps.
Course simulate(const config::Settings& settings, int sweeps) {
  Course run;
  std::mutex mutex;
  std::atomic<int> answers = 0;
  const auto publish = [&](const std::string& channel, std::span<const std::uint8_t> bytes) {
    const std::lock_guard lock(mutex);
    if (channel == kChannels.stairways && answers < sweeps) run.sent.emplace_back(bytes.begin(), bytes.end());
    return true;
  };
  const auto on_pass = [&](const Pass& pass) {
    if (answers >= sweeps) return;
    run.passes.push_back(pass);
    if (!pass.is_preview) ++answers;
  };
  Pipeline pipeline(settings, std::make_unique<SimulatedSource>(settings, 0), publish, on_pass);
  EXPECT_TRUE(comes_true([&] { return answers >= sweeps; }));
  pipeline.stop();
  return run;
}

TEST(Preview, stairway_is_told_before_its_sweep_ends_and_better_and_better) {
  config::Settings settings = quick_settings("straight-flight");
  settings.disk.period_s = 12.0;
  const auto messages = simulate(settings, 1).messages();
  ASSERT_GE(messages.size(), 2u);
  const ipc::StairwaysMessage &first = messages.front(), &last = messages.back();
  EXPECT_FALSE(first.is_final);
  EXPECT_TRUE(last.is_final);
  EXPECT_LT(first.utime_us, last.sweep_start_utime_us + 5'000'000);
  for (std::size_t i = 0; i < messages.size(); ++i) {
    SCOPED_TRACE(i);
    EXPECT_EQ(messages[i].is_final, i + 1 == messages.size());
    EXPECT_EQ(messages[i].sweep, 0);
    EXPECT_EQ(messages[i].sweep_start_utime_us, last.sweep_start_utime_us);
    EXPECT_EQ(messages[i].track_ids, std::vector<std::int64_t>{1});
    EXPECT_TRUE(i == 0 || messages[i].utime_us - messages[i - 1].utime_us > 490'000);
  }
  const detect::Stairway &early = first.detection.stairways.front(), &late = last.detection.stairways.front();
  EXPECT_LT(late.step_depth_sigma, early.step_depth_sigma);
  EXPECT_LT(late.heading_sigma, early.heading_sigma);
  EXPECT_NEAR(early.step_height, late.step_height, 0.003);
  EXPECT_NEAR(early.step_depth, late.step_depth, 0.006);
}

TEST(Preview, final_answers_are_those_without_previews) {
  config::Settings settings = quick_settings("straight-flight");
  const auto with = simulate(settings, 2).sent;
  settings.preview.every_s = 0.0;
  const auto without = simulate(settings, 2).sent;
  ASSERT_EQ(without.size(), 2u);
  EXPECT_GT(with.size(), 3u);
  EXPECT_EQ(with.back(), without.back());
  EXPECT_TRUE(std::ranges::find(with, without.front()) != with.end());
}

TEST(Preview, is_the_same_in_every_run_of_the_same_measurements) {
  const auto one = simulate(quick_settings("two-flights"), 1).sent;
  EXPECT_GT(one.size(), 2u);
  EXPECT_EQ(one, simulate(quick_settings("two-flights"), 1).sent);
}

TEST(Preview, is_sent_only_when_it_shows_a_stairway) {
  const Course run = simulate(quick_settings("empty-room"), 1);
  EXPECT_EQ(run.sent.size(), 1u);
  EXPECT_TRUE(run.messages().front().is_final);
  EXPECT_GT(run.passes.size(), 4u);
  for (const Pass& pass : run.passes) EXPECT_TRUE(pass.message.detection.stairways.empty());
}

TEST(Preview, shows_no_stairway_where_things_only_look_alike) {
  const Course run = simulate(quick_settings("clutter-only"), 1);
  EXPECT_EQ(run.sent.size(), 1u);
}

}  // namespace
}  // namespace stairway::daemon
