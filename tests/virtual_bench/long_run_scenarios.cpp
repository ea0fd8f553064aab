// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <string>
#include <thread>

#include "tests/integration/daemon_process.hpp"
#include "tests/virtual_bench/machine.hpp"
#include "tests/virtual_bench/news.hpp"
#include "tests/virtual_bench/prompt_thread.hpp"
#include "tests/virtual_bench/thread_times.hpp"

namespace stairway::bench {
namespace {

using namespace std::chrono_literals;

std::chrono::seconds duration() {
  const char* seconds = std::getenv("STAIRWAY_BENCH_LONG_S");
  return std::chrono::seconds(seconds == nullptr ? 600 : std::atoi(seconds));
}

std::int64_t drops(const ipc::HealthMessage& health, const std::string& name) {
  for (const auto& [reason, count] : health.drops) {
    if (reason == name) return count;
  }
  return 0;
}

void print_shares(const std::map<std::string, double>& before, const std::map<std::string, double>& after,
                  double elapsed_s) {
  std::printf("%-16s %10s\n", "thread", "share of CPU");
  for (const auto& [name, time_s] : after) {
    const auto earlier = before.find(name);
    const double spent_s = time_s - (earlier == before.end() ? 0.0 : earlier->second);
    std::printf("%-16s %9.1f %%\n", name.c_str(), 100.0 * spent_s / elapsed_s);
  }
  std::fflush(stdout);
}

// How long the machine itself stood still, which its host makes it do when it is busy.
class StillnessWatch {
 public:
  std::chrono::milliseconds longest() const { return longest_.load(); }

 private:
  void run(const std::stop_token& stop) {
    be_prompt();
    auto last = std::chrono::steady_clock::now();
    while (!stop.stop_requested()) {
      std::this_thread::sleep_for(10ms);
      const auto now = std::chrono::steady_clock::now();
      longest_ = std::max(longest_.load(), std::chrono::duration_cast<std::chrono::milliseconds>(now - last));
      last = now;
    }
  }

  std::atomic<std::chrono::milliseconds> longest_ = 0ms;
  std::jthread thread_{[this](const std::stop_token& stop) { run(stop); }};
};

// Of the machine's processor, since it was started.
double idle_time_s() {
  std::ifstream stat("/proc/stat");
  std::string name;
  double user = 0.0, nice = 0.0, system = 0.0, idle = 0.0;
  stat >> name >> user >> nice >> system >> idle;
  return idle / static_cast<double>(::sysconf(_SC_CLK_TCK));
}

TEST(LongRun, streams_at_the_full_rate_without_a_lost_scan) {
  Machine::get();
  News news;
  // As fast as a robot turns it.
  test::DaemonProcess daemon({"--config", BENCH_SETTINGS, "--set", "disk.period_s=35"});
  ASSERT_TRUE(news.wait(60s, [](const Heard& heard) { return heard.health && heard.health->state == "scanning"; }));
  news.clear();
  ASSERT_TRUE(news.wait(60s, [](const Heard& heard) { return heard.scans > 0 && heard.health; }));

  const StillnessWatch stillness;
  const Heard at_start = news.heard();
  const double idle_at_start_s = idle_time_s();
  const auto times_at_start = thread_times_s(daemon.id());
  const auto start = std::chrono::steady_clock::now();
  std::this_thread::sleep_for(duration());
  const double elapsed_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  const auto times_at_end = thread_times_s(daemon.id());
  const Heard at_end = news.heard();

  const auto scans = at_end.last_sequence - at_start.last_sequence;
  std::printf("%lld scans in %.0f s: %.2f a second; %lld lost, %lld answers\n", static_cast<long long>(scans),
              elapsed_s, static_cast<double>(scans) / elapsed_s, static_cast<long long>(at_end.missing_scans),
              static_cast<long long>(at_end.answers));
  std::printf("the machine was idle for %.0f %% of the time, and stood still for at most %lld ms\n",
              100.0 * (idle_time_s() - idle_at_start_s) / elapsed_s,
              static_cast<long long>(stillness.longest().count()));
  print_shares(times_at_start, times_at_end, elapsed_s);
  EXPECT_NEAR(static_cast<double>(scans) / elapsed_s, 40.0, 0.4);
  EXPECT_EQ(at_end.missing_scans, 0);
  EXPECT_EQ(drops(*at_end.health, "lost-scans"), drops(*at_start.health, "lost-scans"));
  EXPECT_EQ(at_end.health->state, "scanning");
  daemon.signal(SIGTERM);
  EXPECT_EQ(daemon.wait(20s), 0);
}

}  // namespace
}  // namespace stairway::bench
