// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
// Takes a cloud through detect_stairways() once, checks the answer and prints what it cost as a line of JSON.
// Usage: detector_run FILE sweep|tower
#include <cstdlib>
#include <exception>
#include <iostream>
#include <stdexcept>
#include <string>

#include "detector/stairway_detector.hpp"
#include "ipc/cloud_file.hpp"
#include "tests/bench/speed/answer_check.hpp"
#include "tests/bench/speed/clouds.hpp"
#include "tests/bench/speed/run_report.hpp"
#include "tools/evaluation/peak_memory.hpp"

namespace stairway::bench {
namespace {

// A merged cloud has no lines of sight to tell a nosing by, and the flight seen last only in part.
Demands demands_of(const std::string& kind) {
  return kind == "sweep" ? Demands{.fewest_seen = 1, .max_height_error_mm = 1.0} : Demands{.max_height_error_mm = 20.0};
}

RunReport run(const std::string& path, const std::string& kind) {
  auto loaded = ipc::read_cloud_file(path);
  if (!loaded) throw std::runtime_error(loaded.error().text);
  const scan::PointCloud& cloud = loaded->cloud;
  RunReport report{.points = static_cast<double>(cloud.points.size())};
  StageWatch watch;
  const evaluation::PeakMemory memory;
  const detect::Detection detection = detect::detect_stairways(cloud, {}, watch.listener());
  watch.stop();
  report.growth_MB = memory.growth_MB();
  report.stages = watch.costs();
  const AnswerCheck check = check_answer(cloud, detection, truths_of(kind), demands_of(kind));
  report.seen = check.seen;
  report.found = check.found;
  report.height_error_mm = check.worst_height_error_mm;
  return report;
}

}  // namespace
}  // namespace stairway::bench

int main(int argc, char** argv) {
  try {
    if (argc != 3) throw std::invalid_argument("usage: detector_run FILE sweep|tower");
    std::cout << stairway::bench::to_json(stairway::bench::run(argv[1], argv[2])) << '\n';
    return EXIT_SUCCESS;
  } catch (const std::exception& error) {
    std::cerr << "detector_run: " << error.what() << '\n';
    return EXIT_FAILURE;
  }
}
