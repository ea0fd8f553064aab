// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tools/evaluation/chart_drawing.hpp"
#include "tools/evaluation/experiment.hpp"
#include "tools/evaluation/result_json.hpp"
#include "tools/evaluation/table_text.hpp"
#include "tools/stairway/arguments.hpp"
#include "tools/stairway/verbs.hpp"

namespace stairway::tools {
namespace {

using evaluation::Experiment;

struct Arguments {
  SettingsArguments settings;
  Format format = Format::Text;
  std::vector<std::string> names;
  evaluation::Request request;
  std::string plots;
};

int list_experiments(Format format) {
  for (const Experiment& experiment : evaluation::experiments()) {
    if (format == Format::Json) {
      print_json_line(nlohmann::ordered_json{{"name", experiment.name}, {"summary", experiment.summary}}.dump());
    } else {
      print(fmt::format("{:<14}{}\n", experiment.name, experiment.summary));
    }
  }
  return kExitDone;
}

std::string known_names() {
  std::string names;
  for (const Experiment& experiment : evaluation::experiments()) names += std::string(experiment.name) + ", ";
  return names + "or all";
}

/// The experiments of these names, in the order they are asked for; each once.
tl::expected<std::vector<const Experiment*>, std::string> choose(const std::vector<std::string>& names) {
  std::vector<const Experiment*> chosen;
  for (const std::string& name : names) {
    bool is_known = name == "all";
    for (const Experiment& experiment : evaluation::experiments()) {
      if (name != "all" && name != experiment.name) continue;
      is_known = true;
      if (std::find(chosen.begin(), chosen.end(), &experiment) == chosen.end()) chosen.push_back(&experiment);
    }
    if (!is_known) return tl::unexpected(fmt::format("there is no experiment '{}'; known are {}", name, known_names()));
  }
  return chosen;
}

std::string time_left(double seconds) {
  if (seconds < 90.0) return fmt::format("{:.0f} s left", seconds);
  return fmt::format("{:.0f} min left", seconds / 60.0);
}

/// Shows how far an experiment has come.
class ProgressLine {
 public:
  ProgressLine(StatusLine& status, std::string_view name) : status_(status), name_(name) {}

  void show(double done, std::string_view next) {
    const double elapsed = std::chrono::duration<double>(Clock::now() - start_).count();
    const std::string left = done > 0.02 ? ", " + time_left(elapsed * (1.0 - done) / done) : "";
    status_.show(fmt::format("{}: {:.0f} %{}: {}", name_, std::floor(100.0 * done), left, next));
  }

 private:
  using Clock = std::chrono::steady_clock;
  StatusLine& status_;
  std::string_view name_;
  Clock::time_point start_ = Clock::now();
};

bool draw_charts(const std::vector<evaluation::Chart>& charts, const std::filesystem::path& folder) {
  bool is_all_drawn = true;
  for (const evaluation::Chart& chart : charts) {
    for (const char* ending : {".svg", ".png"}) {
      const auto drawn = evaluation::draw_chart(folder / (chart.name + ending), chart);
      if (drawn) continue;
      report_error(drawn.error());
      is_all_drawn = false;
    }
  }
  return is_all_drawn;
}

bool evaluate(const Experiment& experiment, const Arguments& arguments) {
  StatusLine status;
  ProgressLine progress(status, experiment.name);
  evaluation::Request request = arguments.request;
  request.progress = [&](double done, std::string_view next) { progress.show(done, next); };
  evaluation::Result result;
  try {
    result = experiment.run(request);
  } catch (const std::exception& error) {
    status.clear();
    report_error(fmt::format("{}: {}", experiment.name, error.what()));
    return false;
  }
  status.clear();
  if (arguments.format == Format::Json) {
    print_json_line(evaluation::result_json(experiment, request, result));
  } else {
    print(fmt::format("{}: {}\nseed {}, share {}\n\n{}\n", experiment.name, experiment.summary, request.seed,
                      request.share, evaluation::result_text(result)));
    flush_output();
  }
  return arguments.plots.empty() || draw_charts(result.charts, arguments.plots);
}

int run(Arguments arguments) {
  if (arguments.names.empty()) return list_experiments(arguments.format);
  const auto chosen = choose(arguments.names);
  if (!chosen) {
    report_error(chosen.error());
    return kExitUsage;
  }
  const auto loaded = load_settings(arguments.settings);
  if (!loaded) {
    report_error(loaded.error().text);
    return kExitUsage;
  }
  arguments.request.settings = loaded->settings;
  if (!arguments.request.data.empty() && !std::filesystem::is_directory(arguments.request.data)) {
    report_error(fmt::format("{}: is not a folder", arguments.request.data.string()));
    return kExitFailed;
  }
  if (!arguments.plots.empty()) {
    std::error_code trouble;
    std::filesystem::create_directories(arguments.plots, trouble);
    if (trouble) {
      report_error(fmt::format("{}: cannot be made: {}", arguments.plots, trouble.message()));
      return kExitFailed;
    }
  }
  bool is_all_done = true;
  for (const Experiment* experiment : *chosen) is_all_done = evaluate(*experiment, arguments) && is_all_done;
  return is_all_done ? kExitDone : kExitFailed;
}

}  // namespace

Action declare_evaluate(CLI::App& command) {
  const auto arguments = std::make_shared<Arguments>();
  command.add_option("EXPERIMENT", arguments->names, "names of experiments, or all; without one, lists them")
      ->type_name("");
  command.add_option("--seed", arguments->request.seed, "of scenes and noise; the same seed gives the same figures")
      ->type_name("N")
      ->check([](const std::string& text) {
        const bool is_whole = !text.empty() && text.find_first_not_of("0123456789") == std::string::npos;
        return is_whole ? std::string() : "must be a whole number of 0 or more: " + text;
      })
      ->capture_default_str();
  command.add_option("--share", arguments->request.share, "of the usual number of runs, above 0 and up to 1")
      ->type_name("F")
      ->check(CLI::Range(1e-6, 1.0).description(""))
      ->capture_default_str();
  command.add_option("--scenes", arguments->request.scenes, "in each case, for accuracy; without it, --share decides")
      ->type_name("N")
      ->check(CLI::Range(1, 100'000).description(""));
  command.add_option("--plots", arguments->plots, "draw the charts into this folder, each as .svg and .png")
      ->type_name("DIR");
  command.add_option("--data", arguments->request.data, "recorded data, for experiments that can use them")
      ->type_name("DIR");
  command
      .add_option("--model", arguments->request.model,
                  "STL of a stairway in metres, going up along x from its first nosing at x = 0, for segmentation")
      ->type_name("FILE");
  add_settings_options(command, arguments->settings);
  add_format_option(command, arguments->format);
  command.footer(
      "Repeats the experiments of the paper in simulated scenes; its figures stand beside those measured here.\n"
      "Examples:\n"
      "  stairway evaluate\n"
      "  stairway evaluate series --share 0.2 --plots plots\n"
      "  stairway evaluate all --seed 50000 --format json > results.jsonl\n"
      "  stairway evaluate strategies --set detector.voxel_mm=20\n"
      "  stairway evaluate segmentation --model stairs.stl\n"
      "Exit codes: 0 done; 1 an experiment failed, data or a model could not be read or a chart not be written (the "
      "others are\n"
      "still done); 2 wrong usage or settings, or an experiment that does not exist.");
  return [arguments] { return run(*arguments); };
}

}  // namespace stairway::tools
