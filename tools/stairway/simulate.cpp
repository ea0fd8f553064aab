// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <cmath>
#include <fstream>
#include <memory>
#include <numbers>
#include <optional>
#include <string>

#include "ipc/stairway_json.hpp"
#include "tools/sim/random_scenes.hpp"
#include "tools/sim/scene_file.hpp"
#include "tools/sim/stl_file.hpp"
#include "tools/sim/sweep.hpp"
#include "tools/stairway/arguments.hpp"
#include "tools/stairway/marked_cloud.hpp"
#include "tools/stairway/source.hpp"
#include "tools/stairway/verbs.hpp"

namespace stairway::tools {
namespace {

struct Arguments {
  SettingsArguments settings;
  Format format = Format::Text;
  std::string scene;
  std::string output;
  std::string truth;
  std::string mesh;
  std::string model;
  std::optional<int> seed;
  std::optional<double> disk_period_s;
  double roll_deg = 0.0;
  double pitch_deg = 0.0;
  bool list = false;
};

double radians(double angle_deg) { return angle_deg * std::numbers::pi / 180.0; }

int list_scenes() {
  for (const std::string& name : sim::shipped_scene_names()) print(name + '\n');
  for (const std::string_view kind : sim::random_scene_kinds()) print(fmt::format("{}:SEED\n", kind));
  return kExitDone;
}

bool write_line(const std::string& path, const std::string& line) {
  std::ofstream file(path, std::ios::binary);
  file << line << '\n' << std::flush;
  if (!file) report_error(fmt::format("{}: cannot be written", path));
  return file.good();
}

bool write_meshes(const sim::Scene& scene, const Arguments& arguments) {
  try {
    if (!arguments.mesh.empty()) sim::write_stl(arguments.mesh, scene.mesh);
    if (!arguments.model.empty()) sim::write_stl(arguments.model, sim::flight_model(scene.stairs.front()));
  } catch (const sim::StlFileError& error) {
    report_error(error.what());
    return false;
  }
  return true;
}

scan::PointCloud sweep_in(const sim::Scene& scene, const Arguments& arguments, const config::Settings& settings) {
  const int seed = arguments.seed.value_or(settings.simulate.seed);
  return simulate_sweep(
      scene, scene.mount.value_or(settings.mount),
      {.robot_roll_rad = radians(arguments.roll_deg), .robot_pitch_rad = radians(arguments.pitch_deg)},
      {.disk_period_s = arguments.disk_period_s.value_or(settings.disk.period_s)},
      static_cast<std::uint64_t>(seed));
}

int simulate(const Arguments& arguments, const config::Settings& settings) {
  auto scene = open_scene(arguments.scene);
  if (!scene) {
    report_error(scene.error().text);
    return kExitFailed;
  }
  if (!arguments.model.empty() && scene->stairs.empty()) {
    report_error(fmt::format("{}: has no stairway to write to {}", arguments.scene, arguments.model));
    return kExitFailed;
  }
  StatusLine status;
  status.show(fmt::format("{}: simulating ...", arguments.scene));
  const scan::PointCloud cloud = sweep_in(*scene, arguments, settings);
  status.clear();
  const std::size_t points = cloud.points.size();
  const std::string truth = ipc::detection_json(arguments.scene, points, {}, {.stairways = scene->truths});
  if (const auto written = write_cloud(arguments.output, cloud); !written) {
    report_error(written.error().text);
    return kExitFailed;
  }
  if (!arguments.truth.empty() && !write_line(arguments.truth, truth)) return kExitFailed;
  if (!write_meshes(*scene, arguments)) return kExitFailed;
  if (arguments.format == Format::Json) {
    print_json_line(truth);
  } else {
    print(fmt::format("{}: {} points written to {}\n", arguments.scene, points, arguments.output));
  }
  return kExitDone;
}

int run(const Arguments& arguments) {
  if (arguments.list) return list_scenes();
  const auto loaded = load_settings(arguments.settings);
  if (!loaded) {
    report_error(loaded.error().text);
    return kExitUsage;
  }
  if (arguments.output.empty()) {
    report_error("simulate needs a SCENE and an --output, or --list");
    return kExitUsage;
  }
  Arguments with_scene = arguments;
  if (with_scene.scene.empty()) with_scene.scene = loaded->settings.simulate.scene;
  return simulate(with_scene, loaded->settings);
}

void declare_simulation(CLI::App& command, Arguments& arguments) {
  command.add_option("--seed", arguments.seed, "of the noise; the setting simulate.seed if left out")
      ->check(CLI::NonNegativeNumber);
  command
      .add_option("--disk-period", arguments.disk_period_s,
                  "one turn of the disk [s], negative is clockwise; the setting disk.period_s if left out")
      ->check([](const std::string& text) {
        double period_s = 0.0;
        const bool is_usable =
            CLI::detail::lexical_cast(text, period_s) && std::abs(period_s) >= 1.0 && std::abs(period_s) <= 600.0;
        return is_usable ? std::string() : "expected 1 to 600 s or -600 to -1 s, found " + text;
      });
  command.add_option("--tilt-roll", arguments.roll_deg, "of the robot, left side up, unknown to it [deg]")
      ->check(CLI::Range(-45.0, 45.0));
  command.add_option("--tilt-pitch", arguments.pitch_deg, "of the robot, front down, unknown to it [deg]")
      ->check(CLI::Range(-45.0, 45.0));
}

}  // namespace

Action declare_simulate(CLI::App& command) {
  const auto arguments = std::make_shared<Arguments>();
  command.add_option("SCENE", arguments->scene, "see --list; or the path of a scene file (.toml)")->type_name("");
  command.add_flag("--list", arguments->list, "print the names of the scenes");
  command.add_option("-o,--output", arguments->output, "the cloud: binary .pcd or .ply")->type_name("FILE");
  command.add_option("--truth", arguments->truth, "the true stairways, in the form of stairway detect --format json")
      ->type_name("FILE");
  command
      .add_option("--mesh", arguments->mesh, "everything in the scene as triangles, in the frame of the truth: .stl")
      ->type_name("FILE");
  command
      .add_option("--model", arguments->model,
                  "the first stairway alone and in its own frame, as stairway evaluate --model takes it: .stl")
      ->type_name("FILE");
  declare_simulation(command, *arguments);
  add_settings_options(command, arguments->settings);
  add_format_option(command, arguments->format);
  command.footer(
      "The truth is in the frame of a robot that stands level, also when the robot is tilted.\n"
      "Examples:\n"
      "  stairway simulate --list\n"
      "  stairway simulate spiral -o spiral.pcd --truth spiral.json\n"
      "  stairway simulate open-risers -o open.pcd --mesh room.stl --model stairs.stl\n"
      "  stairway simulate random-stairs:17 --seed 3 --disk-period 20 -o stairs.ply\n"
      "Exit codes: 0 done; 1 the scene could not be read or a file not written; 2 wrong usage or settings.");
  return [arguments] { return run(*arguments); };
}

}  // namespace stairway::tools
