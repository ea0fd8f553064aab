// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <Eigen/Geometry>
#include <memory>
#include <nlohmann/json.hpp>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "detector/levelling.hpp"
#include "tools/stairway/arguments.hpp"
#include "tools/stairway/recording_source.hpp"
#include "tools/stairway/recording_summary.hpp"
#include "tools/stairway/source.hpp"
#include "tools/stairway/verbs.hpp"

namespace stairway::tools {
namespace {

using Json = nlohmann::ordered_json;

struct Arguments {
  SettingsArguments settings;
  Format format = Format::Text;
  std::vector<std::string> sources;
};

struct CloudFacts {
  Eigen::AlignedBox3f extent;
  std::optional<detect::FloorFit> floor;

  double floor_height_m() const { return -floor->T_level_cloud.translation().z(); }
};

CloudFacts examine(const scan::PointCloud& cloud) {
  CloudFacts facts;
  for (const Eigen::Vector3f& p : cloud.points) facts.extent.extend(p);
  facts.floor = detect::find_floor(cloud);
  return facts;
}

Json as_json(const Eigen::Vector3f& p) { return Json::array({p.x(), p.y(), p.z()}); }

void print_facts_json(const Source& source, const CloudFacts& facts) {
  Json object{{"source", source.name},
              {"points", source.cloud.points.size()},
              {"dropped_points", source.dropped_points},
              {"min", nullptr},
              {"max", nullptr},
              {"sensor_origin", nullptr},
              {"floor", nullptr}};
  if (!facts.extent.isEmpty()) {
    object["min"] = as_json(facts.extent.min());
    object["max"] = as_json(facts.extent.max());
  }
  if (source.cloud.sensor_origin) object["sensor_origin"] = as_json(*source.cloud.sensor_origin);
  if (facts.floor) object["floor"] = {{"tilt", facts.floor->tilt_rad}, {"height", facts.floor_height_m()}};
  print_json_line(object.dump(-1, ' ', false, Json::error_handler_t::replace));
}

void print_facts_text(const Source& source, const CloudFacts& facts) {
  print(fmt::format("{}: {} points\n", source.name, source.cloud.points.size()));
  if (source.dropped_points > 0) print(fmt::format("  {} more without finite place\n", source.dropped_points));
  if (!facts.extent.isEmpty()) {
    const Eigen::Vector3f low = facts.extent.min(), high = facts.extent.max();
    print(fmt::format("  x {:.3f}..{:.3f}, y {:.3f}..{:.3f}, z {:.3f}..{:.3f} m\n", low.x(), high.x(), low.y(),
                      high.y(), low.z(), high.z()));
  }
  if (const auto& origin = source.cloud.sensor_origin)
    print(fmt::format("  sensor at {:.3f} {:.3f} {:.3f} m\n", origin->x(), origin->y(), origin->z()));
  if (facts.floor) {
    print(fmt::format("  floor at z = {:.3f} m, {:.2f} deg from level\n", facts.floor_height_m(),
                      facts.floor->tilt_rad * 180.0 / std::numbers::pi));
  } else {
    print("  no floor that is nearly level\n");
  }
}

bool describe_recording(const std::string& name, Format format) {
  const auto summary = summarise_recording(name);
  if (!summary) {
    report_error(summary.error().text);
    return false;
  }
  format == Format::Json ? print_json_line(recording_json(name, *summary)) : print(recording_text(name, *summary));
  return true;
}

int run(const Arguments& arguments) {
  const auto loaded = load_settings(arguments.settings);
  if (!loaded) {
    report_error(loaded.error().text);
    return kExitUsage;
  }
  int exit_code = kExitDone;
  for (const std::string& name : arguments.sources) {
    if (is_recording(name)) {
      if (!describe_recording(name, arguments.format)) exit_code = kExitFailed;
      continue;
    }
    const auto source = open_source(name, loaded->settings);
    if (!source) {
      report_error(source.error().text);
      exit_code = kExitFailed;
      continue;
    }
    const CloudFacts facts = examine(source->cloud);
    arguments.format == Format::Json ? print_facts_json(*source, facts) : print_facts_text(*source, facts);
  }
  return exit_code;
}

}  // namespace

Action declare_info(CLI::App& command) {
  const auto arguments = std::make_shared<Arguments>();
  command.add_option("SOURCE", arguments->sources, "cloud file (.pcd or .ply), recording (.lcm), or sim:SCENE")
      ->required()
      ->type_name("");
  add_settings_options(command, arguments->settings);
  add_format_option(command, arguments->format);
  command.footer(
      "A floor that is not level, or not at z = 0, asks for --set input.level=floor when detecting.\n"
      "Of a recording it tells what is in it, and what is damaged or missing.\n"
      "Examples:\n"
      "  stairway info scan.pcd\n"
      "  stairway info --format json stairway-000012.lcm | jq .damage\n"
      "Exit codes: 0 done; 1 a SOURCE could not be read (the others are still done); 2 wrong usage or settings.");
  return [arguments] { return run(*arguments); };
}

}  // namespace stairway::tools
