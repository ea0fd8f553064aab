// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "tests/bench/speed/child_process.hpp"
#include "tests/bench/speed/median.hpp"
#include "tests/bench/speed/parts.hpp"
#include "tests/bench/speed/programs.hpp"

namespace stairway::bench {
namespace {

using Json = nlohmann::ordered_json;

struct Run {
  ChildRun process;
  Json answer;
};

Run detect_once(const std::string& file) {
  Run run{.process = run_child({STAIRWAY, "detect", file, "--format", "json"}), .answer = {}};
  run.answer = Json::parse(run.process.output);
  const Json& stairways = run.answer.at("stairways");
  if (stairways.size() != 1 || stairways[0].at("nosings").size() != 10)
    throw std::runtime_error("stairway detect did not find the ten steps of " + file);
  return run;
}

}  // namespace

evaluation::Result run_process(const evaluation::Request& request) {
  const std::filesystem::path file = sweep_file(request.data);
  std::vector<Run> runs;
  const int count = evaluation::shared_count(5, request.share);
  for (int i = 0; i < count; ++i) {
    if (request.progress) request.progress(static_cast<double>(i) / count, fmt::format("run {}", i + 1));
    runs.push_back(detect_once(file));
  }
  const auto of_process = [&](double ChildRun::*figure) {
    return median_of(runs, [&](const Run& run) { return run.process.*figure; });
  };
  evaluation::Table process{
      .name = "process",
      .title = fmt::format("stairway detect of a file with one sweep, whole process, median of {} runs", count),
      .columns = {{"points", "", 0}, {"wall", "ms", 1}, {"cpu", "ms", 1}, {"peak_memory", "MB", 1}},
      .rows = {{runs.front().answer.at("points").get<double>(), of_process(&ChildRun::wall_ms),
                of_process(&ChildRun::cpu_ms), of_process(&ChildRun::peak_MB)}}};
  evaluation::Table timings{.name = "process-timings",
                            .title = "timing_ms of its answers, medians",
                            .columns = {{"stage", "", 0}, {"wall", "ms", 2}},
                            .rows = {}};
  for (const auto& [stage, unused] : runs.front().answer.at("timing_ms").items())
    timings.rows.push_back({stage, median_of(runs, [&name = stage](const Run& run) {
                              return run.answer.at("timing_ms").at(name).get<double>();
                            })});
  return {.tables = {std::move(process), std::move(timings)},
          .charts = {},
          .notes = {"Everything is counted from the start of the program to its end, with the file in the system's "
                    "cache. \"total\" in timing_ms is the detection without reading."}};
}

}  // namespace stairway::bench
