// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "ipc/stairway_json.hpp"
#include "ipc/stairway_text.hpp"
#include "tools/common/stage_timer.hpp"
#include "tools/stairway/arguments.hpp"
#include "tools/stairway/detection_pass.hpp"
#include "tools/stairway/marked_cloud.hpp"
#include "tools/stairway/plot.hpp"
#include "tools/stairway/recording_source.hpp"
#include "tools/stairway/source.hpp"
#include "tools/stairway/truth_table.hpp"
#include "tools/stairway/verbs.hpp"

namespace stairway::tools {
namespace {

struct Arguments {
  SettingsArguments settings;
  Format format = Format::Text;
  std::vector<std::string> sources;
  std::string plot;
  std::string output;
  std::optional<int> sweep;
};

void print_answer(const Source& source, std::size_t points, const DetectionPass& pass, Format format) {
  ipc::Timings timings = source.timings;
  timings.insert(timings.end(), pass.timings.begin(), pass.timings.end());
  if (format == Format::Json) return print_json_line(ipc::detection_json(source.name, points, timings, pass.detection));
  print(ipc::detection_text(source.name, points, timings, pass.detection));
  if (source.dropped_points > 0) print(fmt::format("  {} points without finite place\n", source.dropped_points));
  if (source.truth) print(truth_text(*source.truth, pass.detection.stairways));
}

bool write_pictures(const Arguments& arguments, const Source& source, const DetectionPass& pass) {
  bool is_written = true;
  if (!arguments.plot.empty()) {
    if (const auto drawn = plot_detection(arguments.plot, source.name, pass.cloud, pass.detection); !drawn) {
      report_error(drawn.error());
      is_written = false;
    }
  }
  if (!arguments.output.empty()) {
    const auto written = write_marked_cloud(arguments.output, pass.cloud, pass.detection.stairways);
    if (!written) {
      report_error(written.error().text);
      is_written = false;
    }
  }
  return is_written;
}

bool detect_in(const std::string& name, const Arguments& arguments, const config::Settings& settings) {
  StatusLine status;
  status.show(fmt::format("{}: {} ...", name, name.starts_with("sim:") ? "simulating" : "reading"));
  auto source = open_source(name, settings);
  if (!source) {
    status.clear();
    report_error(source.error().text);
    return false;
  }
  const std::size_t points = source->cloud.points.size();
  const DetectionPass pass = detect_once(std::move(source->cloud), settings, [&](std::string_view stage) {
    status.show(fmt::format("{}: {} ...", name, stage));
  });
  status.clear();
  print_answer(*source, points, pass, arguments.format);
  return write_pictures(arguments, *source, pass);
}

bool detect_in_recording(const std::string& name, const Arguments& arguments) {
  auto recording = open_recording(name, arguments.settings);
  auto sweeps = recording ? open_sweeps(*recording) : tl::unexpected(recording.error());
  if (!sweeps) {
    report_error(sweeps.error().text);
    return false;
  }
  StatusLine status;
  bool is_all_done = true;
  int passes = 0;
  while (true) {
    status.show(fmt::format("{}: reading ...", name));
    StageTimer timer;
    auto sweep = sweeps->next();
    timer.stop();
    if (!sweep) break;
    if (arguments.sweep && *arguments.sweep != static_cast<int>(sweep->number)) continue;
    ++passes;
    const Source source{.name = name, .cloud = {}, .timings = {{"read", timer.total_ms()}}, .truth = {}};
    const std::size_t points = sweep->cloud.points.size();
    const DetectionPass pass = detect_once(std::move(sweep->cloud), recording->settings, [&](std::string_view stage) {
      status.show(fmt::format("{}: {} ...", name, stage));
    });
    status.clear();
    for (const std::string& flaw : sweep->statistics.flaws())
      report_error(fmt::format("{}: sweep {}: {}", name, sweep->number, flaw));
    print_answer(source, points, pass, arguments.format);
    is_all_done = write_pictures(arguments, source, pass) && is_all_done;
  }
  status.clear();
  report_flaws(name, sweeps->measurements());
  if (passes == 0) report_error(fmt::format("{}: there is no sweep {} in it", name, arguments.sweep.value_or(0)));
  return is_all_done && passes > 0;
}

int run(const Arguments& arguments) {
  const auto loaded = load_settings(arguments.settings);
  if (!loaded) {
    report_error(loaded.error().text);
    return kExitUsage;
  }
  if (arguments.sources.size() > 1 && !(arguments.plot.empty() && arguments.output.empty())) {
    report_error("--plot and --output take one SOURCE at a time");
    return kExitUsage;
  }
  bool is_all_done = true;
  for (const std::string& source : arguments.sources)
    is_all_done = (is_recording(source) ? detect_in_recording(source, arguments)
                                        : detect_in(source, arguments, loaded->settings)) &&
                  is_all_done;
  return is_all_done ? kExitDone : kExitFailed;
}

}  // namespace

Action declare_detect(CLI::App& command) {
  const auto arguments = std::make_shared<Arguments>();
  command.add_option("SOURCE", arguments->sources, "cloud file (.pcd or .ply), recording (.lcm), or sim:SCENE")
      ->required()
      ->type_name("");
  add_settings_options(command, arguments->settings);
  add_format_option(command, arguments->format);
  command.add_option("--plot", arguments->plot, "draw the answer from the side and from above, as .png or .svg")
      ->type_name("FILE")
      ->check([](const std::string& file) {
        return is_plottable(file) ? std::string() : "the name must end in .png or .svg: " + file;
      });
  command.add_option("--output", arguments->output, "write the cloud with its stairways coloured, as .ply or .pcd")
      ->type_name("FILE");
  command.add_option("--sweep", arguments->sweep, "only this sweep of a recording; the first is 0")->type_name("N");
  command.footer(
      "Every sweep of a recording is a pass, with the settings that the recording tells; --set changes them, --config\n"
      "replaces them. Of several sweeps the last one is drawn or written.\n"
      "Examples:\n"
      "  stairway detect sim:straight-flight\n"
      "  stairway detect --set detector.voxel_mm=20 stairway-000012.lcm\n"
      "  stairway detect --profile depth-camera --set input.level=floor --plot stairs.png scan.pcd\n"
      "  stairway detect --format json *.ply > answers.jsonl\n"
      "Exit codes: 0 done, also when there is no stairway; 1 a SOURCE could not be read or a file not written (the\n"
      "others are still done); 2 wrong usage or settings.");
  return [arguments] { return run(*arguments); };
}

}  // namespace stairway::tools
