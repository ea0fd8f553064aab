// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
// Runs the parts of the benchmark and prints what they measured; tools/benchmark builds and starts it.
#include <fmt/format.h>
#include <unistd.h>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <vector>

#include "tests/bench/speed/machine.hpp"
#include "tests/bench/speed/parts.hpp"
#include "tests/bench/speed/temporary_folder.hpp"
#include "tools/evaluation/chart_drawing.hpp"
#include "tools/evaluation/result_json.hpp"
#include "tools/evaluation/table_text.hpp"

namespace stairway::bench {
namespace {

using evaluation::Experiment;
using Json = nlohmann::ordered_json;

constexpr std::array<Experiment, 5> kParts{{{"stages", "parts of the detector by themselves", run_stages},
                                            {"pcl", "beside a segmentation made of PCL", run_pcl},
                                            {"growth", "time and memory over the number of points", run_growth},
                                            {"process", "stairway detect from start to end", run_process},
                                            {"daemon", "what the daemon costs at the pace of a robot", run_daemon}}};

struct Arguments {
  std::vector<std::string> parts;
  std::string plots;
  std::string json;
  std::string revision = "unknown";
  double share = 1.0;
};

bool is_wanted(const Arguments& arguments, std::string_view part) {
  return arguments.parts.empty() ||
         std::find(arguments.parts.begin(), arguments.parts.end(), part) != arguments.parts.end();
}

void draw(const std::vector<evaluation::Chart>& charts, const std::filesystem::path& folder) {
  std::filesystem::create_directories(folder);
  for (const evaluation::Chart& chart : charts)
    for (const char* ending : {".svg", ".png"})
      if (const auto drawn = evaluation::draw_chart(folder / (chart.name + ending), chart); !drawn)
        throw std::runtime_error(drawn.error());
}

void show_progress(std::string_view part, std::string_view next) {
  if (isatty(STDERR_FILENO) == 1) fmt::print(stderr, "\r\x1b[K{}: {} ...", part, next);
}

Json run_part(const Experiment& part, evaluation::Request& request, const Arguments& arguments) {
  request.progress = [&](double, std::string_view next) { show_progress(part.name, next); };
  const evaluation::Result result = part.run(request);
  if (isatty(STDERR_FILENO) == 1) fmt::print(stderr, "\r\x1b[K");
  fmt::print("{}: {}\n\n{}\n", part.name, part.summary, evaluation::result_text(result));
  std::fflush(stdout);
  if (!arguments.plots.empty()) draw(result.charts, arguments.plots);
  return Json::parse(evaluation::result_json(part, request, result));
}

void run(const Arguments& arguments) {
  const TemporaryFolder folder;
  evaluation::Request request{.share = arguments.share, .data = folder.path()};
  const Experiment header{"machine", "", nullptr};
  const evaluation::Result machine{.tables = {machine_table(arguments.revision)}, .charts = {}, .notes = {}};
  fmt::print("{}\n", evaluation::result_text(machine));
  Json all = Json::array({Json::parse(evaluation::result_json(header, request, machine))});
  for (const Experiment& part : kParts)
    if (is_wanted(arguments, part.name)) all.push_back(run_part(part, request, arguments));
  if (arguments.json.empty()) return;
  std::ofstream file(arguments.json);
  if (!(file << all.dump(1) << '\n')) throw std::runtime_error(arguments.json + ": cannot be written");
}

}  // namespace
}  // namespace stairway::bench

int main(int argc, char** argv) {
  using namespace stairway::bench;
  Arguments arguments;
  CLI::App app("Measures what the detector costs.", "benchmark");
  std::vector<std::string> names;
  for (const auto& part : kParts) names.emplace_back(part.name);
  app.add_option("PART", arguments.parts, "what to measure; everything without one")->check(CLI::IsMember(names));
  app.add_option("--plots", arguments.plots, "draw the charts into this folder, each as .svg and .png");
  app.add_option("--json", arguments.json, "write all tables into this file");
  app.add_option("--share", arguments.share, "of the usual rounds and sizes, above 0 and up to 1")
      ->check(CLI::Range(1e-6, 1.0));
  app.add_option("--revision", arguments.revision, "of the sources, to be printed");
  CLI11_PARSE(app, argc, argv);
  try {
    run(arguments);
    return EXIT_SUCCESS;
  } catch (const std::exception& error) {
    std::cerr << "\nbenchmark: " << error.what() << '\n';
    return EXIT_FAILURE;
  }
}
