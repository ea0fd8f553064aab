// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include <fcntl.h>
#include <fmt/format.h>
#include <pthread.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "drivers/disk_encoder.hpp"
#include "drivers/gpio/encoder_lines.hpp"
#include "drivers/gpio/gpio_lines.hpp"
#include "drivers/gpio/libgpiod_edge_port.hpp"
#include "drivers/host_clock.hpp"

namespace {

using namespace stairway;
using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;

constexpr int kCountsPerTurn = 1024;
constexpr std::size_t kMeasuredTurns = 8;
constexpr auto kStallPeriod = 100ms;  // short enough for the fastest run to have some

/// Lines A, B and index of a gpio-sim chip, moved by writing their pulls.
class Pulls {
 public:
  explicit Pulls(const std::filesystem::path& lines) {
    for (std::size_t line = 0; line < files_.size(); ++line) {
      const auto file = lines / fmt::format("sim_gpio{}", line) / "pull";
      files_[line] = drivers::FileDescriptor(::open(file.c_str(), O_WRONLY | O_CLOEXEC));
      if (!files_[line].is_open()) throw std::runtime_error(fmt::format("cannot write {}", file.string()));
    }
  }
  void set(std::size_t line, bool level) {
    const std::string_view pull = level ? "pull-up" : "pull-down";
    if (::pwrite(files_[line].get(), pull.data(), pull.size(), 0) < 0) throw std::runtime_error("the chip went away");
  }

 private:
  std::array<drivers::FileDescriptor, 3> files_;
};

/// Turns forwards by so many edges of A and B, at that rate or, for 0, as fast as it goes.
/// @return The rate that was reached [1/s].
double turn(Pulls& pulls, int edges, double rate_hz) {
  // The reader always comes first, as an interrupt would.
  const sched_param parameters{};
  ::pthread_setschedparam(::pthread_self(), SCHED_IDLE, &parameters);
  const Clock::time_point start = Clock::now();
  for (int count = 1; count <= edges; ++count) {
    while (rate_hz > 0.0 && Clock::now() < start + std::chrono::duration<double>(count / rate_hz)) {
    }
    const int phase = count % 4;
    if (count % 2 == 0) {
      pulls.set(0, phase == 2);
    } else {
      pulls.set(1, phase == 1);
    }
    if (count % kCountsPerTurn == 0) {
      pulls.set(2, true);
      pulls.set(2, false);
    }
  }
  return edges / std::chrono::duration<double>(Clock::now() - start).count();
}

struct Measurement {
  double reached_hz = 0.0;
  drivers::EncoderCounters counters;
  int sent = 0;  // of all three lines
  int stalls = 0;
};

Measurement measure(const drivers::EncoderOptions& options, Pulls& pulls, double rate_hz,
                    std::chrono::milliseconds stall) {
  drivers::DiskEncoder encoder({[&] { return drivers::open_encoder_lines(options); }}, drivers::monotonic_now_ns,
                               options);
  encoder.poll(1ms);
  if (!encoder.is_port_open()) throw std::runtime_error(drivers::open_encoder_lines(options).error());
  Measurement measurement;
  const int edges = static_cast<int>(kMeasuredTurns) * kCountsPerTurn;
  std::atomic<bool> is_done = false;
  std::thread toggler([&] {
    measurement.reached_hz = turn(pulls, edges, rate_hz);
    is_done = true;
  });
  Clock::time_point next_stall = Clock::now() + kStallPeriod / 2;
  while (!is_done) {
    encoder.poll(20ms);
    if (stall > 0ms && Clock::now() >= next_stall) {
      std::this_thread::sleep_for(stall);
      next_stall = Clock::now() + kStallPeriod;
      ++measurement.stalls;
    }
  }
  toggler.join();
  const Clock::time_point end = Clock::now() + 100ms;
  while (Clock::now() < end) encoder.poll(20ms);
  measurement.counters = encoder.session().counters();
  measurement.sent = edges + 2 * static_cast<int>(kMeasuredTurns);
  return measurement;
}

int faults_of(const drivers::EncoderCounters& counters) {
  using drivers::EncoderTrouble;
  return static_cast<int>(counters.count(EncoderTrouble::MissedPair) +
                          counters.count(EncoderTrouble::IllegalTransition) +
                          counters.count(EncoderTrouble::IndexDeviation));
}

/// The highest reached rates without a lost edge, of runs without and with stalls; 0 when there was none.
struct Highest {
  double unstalled_hz = 0.0;
  double stalled_hz = 0.0;

  void take(const Measurement& m, bool is_stalled) {
    const bool is_whole = m.sent == static_cast<int>(m.counters.edges) && m.counters.lost_edges == 0;
    if (!is_whole || faults_of(m.counters) > 0) return;
    double& highest_hz = is_stalled ? stalled_hz : unstalled_hz;
    highest_hz = std::max(highest_hz, m.reached_hz);
  }
};

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("How fast the encoder's edges may come, by the kernel's interface and by libgpiod.", "edge_rate");
  drivers::EncoderOptions options;
  options.counts_per_turn = kCountsPerTurn;
  std::string lines;
  std::vector<double> rates{100, 1000, 2000, 5000, 10000, 20000, 0};
  std::vector<int> stalls{0, 20};
  app.add_option("--chip", options.chip, "The GPIO chip, its lines being A, B and index")->required();
  app.add_option("--lines", lines, "The folder of the chip with a folder for each line")->required();
  app.add_option("--rate", rates, "Edges of A and B per second; 0 is as fast as it goes");
  app.add_option("--stall", stalls, "The reader is away for so many milliseconds, every 100 ms");
  CLI11_PARSE(app, argc, argv);
  try {
    Pulls pulls(lines);
    fmt::print("{:<16} {:>8} {:>10} {:>10} {:>8} {:>8} {:>8} {:>8} {:>8}\n", "access", "stall ms", "wanted /s",
               "reached /s", "sent", "missing", "told", "faults", "stalls");
    std::string summary;
    for (const auto access : {drivers::GpioAccess::Libgpiod, drivers::GpioAccess::Kernel}) {
      options.access = access;
      const std::string name = access == drivers::GpioAccess::Kernel ? "kernel" : drivers::libgpiod_name();
      Highest highest;
      for (const int stall : stalls) {
        for (const double rate : rates) {
          const Measurement m = measure(options, pulls, rate, std::chrono::milliseconds(stall));
          highest.take(m, stall > 0);
          fmt::print("{:<16} {:>8} {:>10} {:>10.0f} {:>8} {:>8} {:>8} {:>8} {:>8}\n", name, stall,
                     rate > 0.0 ? fmt::format("{:.0f}", rate) : "most", m.reached_hz, m.sent,
                     m.sent - static_cast<int>(m.counters.edges), m.counters.lost_edges, faults_of(m.counters),
                     m.stalls);
          std::fflush(stdout);
        }
      }
      summary += fmt::format("{}: highest rate without a lost edge: {:.0f} /s, with stalls {:.0f} /s\n", name,
                             highest.unstalled_hz, highest.stalled_hz);
    }
    fmt::print("{}", summary);
  } catch (const std::exception& error) {
    fmt::print(stderr, "edge_rate: {}\n", error.what());
    return 1;
  }
  return 0;
}
