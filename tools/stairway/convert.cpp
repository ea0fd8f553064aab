// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <algorithm>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "ipc/message_codec.hpp"
#include "ipc/recording/event_log_reader.hpp"
#include "tools/stairway/arguments.hpp"
#include "tools/stairway/detection_pass.hpp"
#include "tools/stairway/marked_cloud.hpp"
#include "tools/stairway/recording_source.hpp"
#include "tools/stairway/source.hpp"
#include "tools/stairway/tables.hpp"
#include "tools/stairway/verbs.hpp"

namespace stairway::tools {
namespace {

struct Arguments {
  SettingsArguments settings;
  std::string source;
  std::string output;
  std::string what;
  std::optional<int> sweep;
  bool labels = false;
};

using Failure = std::optional<std::string>;

template <class T, class Error>
Failure failure(const tl::expected<T, Error>& done) {
  return done ? Failure() : Failure(done.error().text);
}

std::string ending_of(const std::string& path) { return std::filesystem::path(path).extension().string(); }

Failure write_points(const Arguments& arguments, const scan::PointCloud& cloud, const CloudMarks& marks) {
  const std::string ending = ending_of(arguments.output);
  if (ending == ".pcd" || ending == ".ply")
    return failure(write_cloud(arguments.output, cloud, {.colours = marks.colours, .labels = marks.labels}));
  TableFile file(arguments.output);
  ending == ".csv" ? write_points_csv(file, cloud, marks.labels) : write_points_json(file, cloud, marks.labels);
  return failure(file.close());
}

Failure convert_cloud(const Arguments& arguments, scan::PointCloud cloud, const config::Settings& settings) {
  CloudMarks marks;
  if (arguments.labels) {
    DetectionPass pass = detect_once(std::move(cloud), settings);
    marks = mark_stairways(pass.cloud, pass.detection.stairways);
    cloud = std::move(pass.cloud);
  }
  if (auto failed = write_points(arguments, cloud, marks)) return failed;
  print(fmt::format("{}: {} points\n", arguments.output, cloud.points.size()));
  return std::nullopt;
}

/// The sweep that was asked for; else the last whole one, or the last if none is whole.
std::optional<scan::Sweep> pick_sweep(RecordedSweeps& sweeps, std::optional<int> number) {
  std::optional<scan::Sweep> picked;
  while (auto sweep = sweeps.next()) {
    if (number && static_cast<int>(sweep->number) == *number) return sweep;
    const bool is_better = !picked || sweep->statistics.is_whole_turn || !picked->statistics.is_whole_turn;
    if (!number && is_better) picked = std::move(sweep);
  }
  return picked;
}

Failure convert_sweep(const Arguments& arguments) {
  const auto recording = open_recording(arguments.source, arguments.settings);
  auto sweeps = recording ? open_sweeps(*recording) : tl::unexpected(recording.error());
  if (!sweeps) return sweeps.error().text;
  auto sweep = pick_sweep(*sweeps, arguments.sweep);
  report_flaws(arguments.source, sweeps->measurements());
  if (!sweep) return fmt::format("{}: there is no sweep {} in it", arguments.source, arguments.sweep.value_or(0));
  for (const std::string& flaw : sweep->statistics.flaws())
    report_error(fmt::format("{}: sweep {}: {}", arguments.source, sweep->number, flaw));
  return convert_cloud(arguments, std::move(sweep->cloud), recording->settings);
}

Failure convert_source(const Arguments& arguments) {
  if (is_recording(arguments.source)) return convert_sweep(arguments);
  const auto loaded = load_settings(arguments.settings);
  if (!loaded) return loaded.error().text;
  auto source = open_source(arguments.source, loaded->settings);
  if (!source) return source.error().text;
  return convert_cloud(arguments, std::move(source->cloud), loaded->settings);
}

/// Writes the messages on one channel as a table.
template <class Message>
Failure convert_messages(const Arguments& arguments, const std::string& name, const std::string& heading) {
  auto reader = ipc::EventLogReader::open(arguments.source);
  if (!reader) return reader.error().text;
  const bool is_csv = ending_of(arguments.output) == ".csv";
  TableFile file(arguments.output);
  if (is_csv) file.write(heading);
  std::uint64_t messages = 0, undecodable = 0;
  while (const auto event = reader->next()) {
    if (!event->channel.ends_with(name)) continue;
    const auto message = ipc::decode<Message>(event->bytes);
    ++(message ? messages : undecodable);
    if (message) file.write(is_csv ? csv_lines(*message) : json_line(*message));
  }
  if (const std::string damage = describe(reader->damage()); !damage.empty())
    report_error(fmt::format("{}: {}", arguments.source, damage));
  if (undecodable > 0) report_error(fmt::format("{}: {} messages cannot be decoded", arguments.source, undecodable));
  if (auto failed = failure(file.close())) return failed;
  if (messages == 0) return fmt::format("{}: there is no message on a channel named ...{}", arguments.source, name);
  print(fmt::format("{}: {} messages\n", arguments.output, messages));
  return std::nullopt;
}

Failure convert(const Arguments& arguments, const std::string& what) {
  if (what == "scans") return convert_messages<ipc::ScanMessage>(arguments, "SCAN", scans_csv_heading());
  if (what == "angles") return convert_messages<ipc::AnglesMessage>(arguments, "ANGLES", angles_csv_heading());
  if (what == "health") return convert_messages<ipc::HealthMessage>(arguments, "HEALTH", health_csv_heading());
  if (what == "stairways")
    return convert_messages<ipc::StairwaysMessage>(arguments, "STAIRWAYS", stairways_csv_heading());
  return convert_source(arguments);
}

std::string usage_problem(const Arguments& arguments, const std::string& what) {
  const std::string ending = ending_of(arguments.output);
  const bool is_table = ending == ".csv" || ending == ".json";
  if (!is_table && ending != ".pcd" && ending != ".ply")
    return "the name after --output must end in .pcd, .ply, .csv or .json: " + arguments.output;
  if (what == "cloud") return {};
  if (!is_table) return fmt::format("{} go into .csv or .json", what);
  if (!is_recording(arguments.source)) return fmt::format("{} are in recordings (.lcm) only", what);
  return arguments.labels ? "--labels is for clouds" : "";
}

int run(const Arguments& arguments) {
  const bool is_answers = is_recording(arguments.source) && ending_of(arguments.output) == ".json";
  const std::string what = !arguments.what.empty() ? arguments.what : is_answers ? "stairways" : "cloud";
  if (const std::string problem = usage_problem(arguments, what); !problem.empty()) {
    report_error(problem);
    return kExitUsage;
  }
  const Failure failed = convert(arguments, what);
  if (failed) report_error(*failed);
  return failed ? kExitFailed : kExitDone;
}

}  // namespace

Action declare_convert(CLI::App& command) {
  const auto arguments = std::make_shared<Arguments>();
  command.add_option("SOURCE", arguments->source, "recording (.lcm), cloud file (.pcd or .ply), or sim:SCENE")
      ->required()
      ->type_name("");
  command.add_option("--output,-o", arguments->output, "the file to write: .pcd, .ply, .csv or .json")
      ->required()
      ->type_name("FILE");
  command
      .add_option("--what", arguments->what,
                  "cloud, scans, angles, stairways or health; of a recording a .json holds the stairways, any other "
                  "file the cloud of a sweep")
      ->check(CLI::IsMember({"cloud", "scans", "angles", "stairways", "health"}).description(""))
      ->type_name("WHAT");
  command.add_option("--sweep", arguments->sweep, "which sweep of a recording, the first is 0; the last whole one")
      ->type_name("N");
  command.add_flag("--labels", arguments->labels,
                   "look for stairways and mark their points: label 1 for the first stairway, 0 elsewhere; in .pcd and "
                   ".ply treads blue, risers green");
  add_settings_options(command, arguments->settings);
  command.footer(
      "Examples:\n"
      "  stairway convert stairway-000012.lcm -o sweep.ply --labels\n"
      "  stairway convert stairway-000012.lcm -o beams.csv --what scans\n"
      "  stairway convert stairway-000012.lcm -o stairs.json\n"
      "  stairway convert scan.ply -o scan.pcd\n"
      "Exit codes: 0 done; 1 the SOURCE could not be read, lacks what was asked for, or the file could not be\n"
      "written; 2 wrong usage.");
  return [arguments] { return run(*arguments); };
}

}  // namespace stairway::tools
