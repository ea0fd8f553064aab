// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
// How long after a sweep's begin, in its own time, is the first stairway told?
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdlib>
#include <iostream>
#include <memory>
#include <numeric>
#include <thread>
#include <vector>

#include "tests/tools/temporary_folder.hpp"
#include "tools/sim/random.hpp"
#include "tools/stairwayd/pipeline.hpp"
#include "tools/stairwayd/simulated_source.hpp"

namespace stairway::daemon {
namespace {

using namespace std::chrono_literals;

constexpr auto kPatience = 300s;  // for one run

std::string scene_text(double bearing_deg) {
  return fmt::format(
      "[room]\nx_m = [-8, 8]\ny_m = [-8, 8]\nheight_m = 2.8\n[[stairs]]\nsteps = 10\nheight_m = 0.17\ndepth_m = 0.29\n"
      "width_m = 1.2\nrailing = \"both\"\nlanding_m = 1.4\ndistance_m = 2.0\nbearing_deg = {}\n",
      bearing_deg);
}

/// In the first sweep, which begins where the disk has its index [s]; negative when that shows none.
double first_sight_s(const config::Settings& settings) {
  std::atomic<bool> is_over = false;
  double first_s = -1.0;
  const auto on_pass = [&](const Pass& pass) {
    if (is_over) return;
    const ipc::StairwaysMessage& message = pass.message;
    if (pass.is_sent && !message.detection.stairways.empty())
      first_s = 1e-6 * static_cast<double>(message.utime_us - message.sweep_start_utime_us);
    is_over = first_s >= 0.0 || !pass.is_preview;
  };
  const auto publish = [](const std::string&, std::span<const std::uint8_t>) { return true; };
  Pipeline pipeline(settings, std::make_unique<SimulatedSource>(settings, 0), publish, on_pass);
  const auto end = std::chrono::steady_clock::now() + kPatience;
  while (!is_over && std::chrono::steady_clock::now() < end) std::this_thread::sleep_for(5ms);
  pipeline.stop();
  return first_s;
}

TEST(PreviewLatency, stairway_at_two_metres_is_told_long_before_the_disk_has_turned_once) {
  const char* wanted = std::getenv("STAIRWAY_PREVIEW_RUNS");
  const int runs = wanted == nullptr ? 24 : std::atoi(wanted);
  const test::TemporaryFolder folder;
  sim::Random random(1);
  std::vector<double> seconds;
  for (int run = 0; run < runs; ++run) {
    // One in each of as many sectors: the mean over few runs is then nearly that over all.
    const double bearing_deg = -180.0 + 360.0 * (run + random.uniform()) / runs;
    test::write_text(folder.path("scene.toml"), scene_text(bearing_deg));
    config::Settings settings;
    settings.simulate.scene = folder.path("scene.toml");
    settings.simulate.speed = 0.0;
    settings.simulate.seed = run;
    seconds.push_back(first_sight_s(settings));
    EXPECT_GT(seconds.back(), 0.0) << bearing_deg;
    std::cout << fmt::format("at {:7.1f} deg from the index: after {:5.2f} s\n", bearing_deg, seconds.back());
  }
  const double mean_s = std::accumulate(seconds.begin(), seconds.end(), 0.0) / static_cast<double>(runs);
  const double latest_s = *std::ranges::max_element(seconds);
  std::cout << fmt::format("{} runs: mean {:.2f} s, latest {:.2f} s of a sweep of {:g} s\n", runs, mean_s, latest_s,
                           config::Settings{}.disk.period_s);
  EXPECT_LE(mean_s, 8.0);
  EXPECT_LE(latest_s, 20.0);
}

}  // namespace
}  // namespace stairway::daemon
