// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/virtual_bench/thread_times.hpp"

#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <system_error>

namespace stairway::bench {
namespace {

// After the name, which may hold anything: the state, and ten fields before the times.
constexpr int kFieldsBeforeTimes = 11;

}  // namespace

std::map<std::string, double> thread_times_s(pid_t process) {
  std::map<std::string, double> times;
  std::error_code ignored;
  const auto tasks = std::filesystem::path("/proc") / std::to_string(process) / "task";
  for (const auto& task : std::filesystem::directory_iterator(tasks, ignored)) {
    std::string line;
    std::getline(std::ifstream(task.path() / "stat"), line);
    const auto begin = line.find('('), end = line.rfind(')');
    if (begin == std::string::npos || end == std::string::npos) continue;
    std::istringstream fields(line.substr(end + 1));
    std::string field;
    for (int i = 0; i < kFieldsBeforeTimes; ++i) fields >> field;
    double user = 0.0, system = 0.0;
    fields >> user >> system;
    times[line.substr(begin + 1, end - begin - 1)] += (user + system) / static_cast<double>(::sysconf(_SC_CLK_TCK));
  }
  return times;
}

}  // namespace stairway::bench
