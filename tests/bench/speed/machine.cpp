// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/bench/speed/machine.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <ctime>
#include <fstream>
#include <thread>

namespace stairway::bench {
namespace {

// What stands behind the colon in the first line that begins with `key`.
std::string value_in(const char* file, const std::string& key) {
  std::ifstream lines(file);
  for (std::string line; std::getline(lines, line);) {
    if (!line.starts_with(key)) continue;
    const std::size_t begin = line.find_first_not_of(" \t", line.find(':') + 1);
    return begin == std::string::npos ? "" : line.substr(begin);
  }
  return "unknown";
}

std::string first_line(const char* file) {
  std::ifstream lines(file);
  std::string line;
  return std::getline(lines, line) ? line : "unknown";
}

}  // namespace

evaluation::Table machine_table(const std::string& revision) {
  return {.name = "machine",
          .title = "Measured on",
          .columns = {{"what", "", 0}, {"value", "", 0}},
          .rows = {{"processor", value_in("/proc/cpuinfo", "model name")},
                   {"cores", std::to_string(std::thread::hardware_concurrency())},
                   {"memory", value_in("/proc/meminfo", "MemTotal")},
                   {"load averages before", first_line("/proc/loadavg")},
                   {"compiler", "GCC " __VERSION__},
                   {"optimisation", BENCHMARK_FLAGS},
                   {"sources", revision},
                   {"time", fmt::format("{:%Y-%m-%d %H:%M}", fmt::gmtime(std::time(nullptr)))}}};
}

}  // namespace stairway::bench
