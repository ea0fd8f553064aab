// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>

#include "tests/bench/speed/child_process.hpp"
#include "tests/bench/speed/parts.hpp"

namespace stairway::bench {

evaluation::Result run_stages(const evaluation::Request& request) {
  const std::string rounds = std::to_string(std::max(2, evaluation::shared_count(5, request.share)));
  if (request.progress) request.progress(0.0, "all stages");
  const ChildRun run = run_child({STAGE_BENCHMARKS, "--benchmark_format=json", "--benchmark_min_time=0.1",
                                  "--benchmark_repetitions=" + rounds, "--benchmark_report_aggregates_only=true"});
  evaluation::Table table{
      .name = "stages",
      .title = "Parts of the detector by themselves, one sweep of 1.5 million points, median of " + rounds + " rounds",
      .columns = {{"part", "", 0}, {"wall", "ms", 2}, {"cpu", "ms", 2}},
      .rows = {}};
  const nlohmann::json output = nlohmann::json::parse(run.output);
  for (const auto& entry : output.at("benchmarks")) {
    if (entry.value("aggregate_name", "") != "median") continue;
    std::string name = entry.at("run_name");
    name.erase(name.find('/'));
    table.rows.push_back({name, entry.at("real_time").get<double>(), entry.at("cpu_time").get<double>()});
  }
  return {
      .tables = {std::move(table)},
      .charts = {},
      .notes = {"Each part is one public function, called again and again with what the part before it gave, on the "
                "threads it takes by itself (one, unless it says otherwise); detect_stairways is the whole, on the "
                "threads of the settings. What the parts leave out of the whole, and save by finding memory "
                "warm, makes their sum differ from it.",
                "\"without_patches\" is what a sweep would cost if patches were off: it is not part of the "
                "whole, nor are group_by_cell and voxel_grid of all points, and read_pcd."}};
}

}  // namespace stairway::bench
