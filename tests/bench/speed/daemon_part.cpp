// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include <sstream>
#include <stdexcept>
#include <string>

#include "tests/bench/speed/child_process.hpp"
#include "tests/bench/speed/parts.hpp"

namespace stairway::bench {
namespace {

// Lines such as "  detection          12.3 % of one core", below one without indent for each way to run the daemon.
evaluation::Table read_costs(const std::string& text) {
  evaluation::Table table{
      .name = "daemon",
      .title = "What the daemon costs at the pace of a real robot, a turn in 35 s",
      .columns = {{"run", "", 0}, {"of", "", 0}, {"share_of_one_core", "%", 1}, {"memory", "MB", 1}},
      .rows = {}};
  std::istringstream lines(text);
  std::string run;
  for (std::string line; std::getline(lines, line);) {
    if (!line.starts_with("  ")) {
      run = line.substr(0, line.find_first_of(",:"));
      if (run.starts_with("replay")) run = "replay";
      continue;
    }
    const std::size_t number = line.find_last_of("0123456789");
    const std::size_t begin = line.find_last_of(' ', number) + 1;
    std::string name = line.substr(2, begin - 2);
    name.erase(name.find_last_not_of(' ') + 1);
    const double value = std::stod(line.substr(begin));
    if (line.ends_with("MB"))
      table.rows.push_back({run, name, {}, value});
    else
      table.rows.push_back({run, name, value, {}});
  }
  if (table.rows.empty()) throw std::runtime_error("daemon-cost said nothing");
  return table;
}

}  // namespace

evaluation::Result run_daemon(const evaluation::Request& request) {
  if (request.progress) request.progress(0.0, "four minutes at the pace of a robot");
  const ChildRun run = run_child({PRIVATE_NETWORK, DAEMON_COST, "--simulate", STAIRWAYD});
  return {.tables = {read_costs(run.output)},
          .charts = {},
          .notes = {"The simulated robot casts rays as well, which no robot does; the replay of its recording leaves "
                    "that out. Shares are CPU time over wall time, so other programs change them little."}};
}

}  // namespace stairway::bench
