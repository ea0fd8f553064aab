// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <algorithm>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "config/settings_reference.hpp"
#include "config/settings_table.hpp"
#include "tools/stairway/arguments.hpp"
#include "tools/stairway/verbs.hpp"

namespace stairway::tools {
namespace {

using config::ShownSetting;
using Json = nlohmann::ordered_json;

struct Arguments {
  SettingsArguments settings;
  Format format = Format::Text;
  std::string task = "show";
};

/// TOML and JSON write numbers, switches, texts and lists alike.
Json as_json(const std::string& toml) {
  Json value = Json::parse(toml, nullptr, false);
  return value.is_discarded() ? Json(toml) : value;
}

void print_settings(const std::vector<ShownSetting>& settings, bool is_diff, Format format) {
  std::map<std::string, std::string> defaults;
  for (const ShownSetting& setting : config::show_settings(config::LoadedSettings{}))
    defaults[setting.key] = setting.value;
  std::size_t widest = 0;
  for (const ShownSetting& setting : settings) widest = std::max(widest, setting.key.size() + setting.value.size());
  for (const ShownSetting& setting : settings) {
    if (format == Format::Json) {
      const Json object{{"key", setting.key},
                        {"value", as_json(setting.value)},
                        {"default", as_json(defaults[setting.key])},
                        {"range", setting.range},
                        {"live", config::changes_live(setting.key)},
                        {"doc", setting.doc},
                        {"origin", setting.origin}};
      print_json_line(object.dump());
    } else {
      const std::size_t padding = widest - setting.key.size() - setting.value.size();
      print(fmt::format("{} = {}{:{}}  # {}{}\n", setting.key, setting.value, "", padding, setting.origin,
                        is_diff ? "; default " + defaults[setting.key] : ""));
    }
  }
}

std::vector<ShownSetting> changed(const std::vector<ShownSetting>& settings) {
  const auto defaults = config::show_settings(config::LoadedSettings{});
  std::vector<ShownSetting> result;
  for (std::size_t i = 0; i < settings.size(); ++i) {
    if (settings[i].value != defaults[i].value) result.push_back(settings[i]);
  }
  return result;
}

void print_verdict(const std::string& problem, const std::vector<std::string>& files, std::size_t changed,
                   Format format) {
  if (format == Format::Json) {
    const Json object{{"ok", problem.empty()}, {"problem", problem}, {"files", files}, {"set", changed}};
    print_json_line(object.dump(-1, ' ', false, Json::error_handler_t::replace));
  } else if (problem.empty()) {
    print(fmt::format("the settings are usable; {} differ from their default; {}\n", changed,
                      files.empty() ? "no file was read" : fmt::format("read: {}", fmt::join(files, ", "))));
  }
}

int run(const Arguments& arguments) {
  if (arguments.task == "reference") {
    print(config::settings_reference());
    return kExitDone;
  }
  const SettingsArguments sources = as_the_daemon(arguments.settings);
  const auto loaded = load_settings(sources);
  const bool is_check = arguments.task == "check", is_diff = arguments.task == "diff";
  if (!loaded) {
    if (is_check) print_verdict(loaded.error().text, sources.files, 0, arguments.format);
    report_error(loaded.error().text);
    return is_check ? kExitFailed : kExitUsage;
  }
  const auto shown = config::show_settings(*loaded);
  if (is_check) {
    print_verdict({}, sources.files, changed(shown).size(), arguments.format);
  } else {
    print_settings(is_diff ? changed(shown) : shown, is_diff, arguments.format);
  }
  return kExitDone;
}

}  // namespace

Action declare_config(CLI::App& command) {
  const auto arguments = std::make_shared<Arguments>();
  command
      .add_option("TASK", arguments->task,
                  "show: every setting and where its value comes from (the default); check: whether stairwayd would "
                  "take them; diff: those that differ from their default; reference: every key with its default and "
                  "meaning, as "
                  "the page docs/settings.md")
      ->check(CLI::IsMember({"show", "check", "diff", "reference"}).description(""))
      ->type_name("show|check|diff|reference");
  add_settings_options(command, arguments->settings);
  add_format_option(command, arguments->format);
  command.footer(
      "The files are those that the daemon reads: --config or else /etc/stairwayd/stairwayd.toml, then *.toml in the\n"
      "folder conf.d beside it. What show and diff print is itself a settings file.\n"
      "Examples:\n"
      "  stairway config show --profile depth-camera\n"
      "  stairway config check --config /etc/stairwayd/stairwayd.toml\n"
      "  stairway config diff --config robot.toml --set detector.voxel_mm=20\n"
      "Exit codes: 0 done; 1 check refuses the settings; 2 wrong usage, or settings that cannot be shown.");
  return [arguments] { return run(*arguments); };
}

}  // namespace stairway::tools
