// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <algorithm>
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

void print_settings(const std::vector<ShownSetting>& settings, Format format) {
  std::size_t widest = 0;
  for (const ShownSetting& setting : settings) widest = std::max(widest, setting.key.size() + setting.value.size());
  for (const ShownSetting& setting : settings) {
    if (format == Format::Json) {
      const Json object{{"key", setting.key},     {"value", as_json(setting.value)},
                        {"range", setting.range}, {"live", config::changes_live(setting.key)},
                        {"doc", setting.doc},     {"origin", setting.origin}};
      print_json_line(object.dump());
    } else {
      const std::size_t padding = widest - setting.key.size() - setting.value.size();
      print(fmt::format("{} = {}{:{}}  # {}\n", setting.key, setting.value, "", padding, setting.origin));
    }
  }
}

std::vector<ShownSetting> changed(const std::vector<ShownSetting>& settings) {
  const auto defaults = config::show_settings(config::LoadedSettings{});
  std::vector<ShownSetting> result;
  for (std::size_t i = 0; i < settings.size(); ++i) {
    if (settings[i].value == defaults[i].value) continue;
    result.push_back(settings[i]);
    result.back().origin += fmt::format("; default {}", defaults[i].value);
  }
  return result;
}

void print_verdict(const std::string& problem, std::size_t set_keys, Format format) {
  if (format == Format::Json) {
    const Json object{{"ok", problem.empty()}, {"problem", problem}, {"set", set_keys}};
    print_json_line(object.dump(-1, ' ', false, Json::error_handler_t::replace));
  } else if (problem.empty()) {
    print(fmt::format("the settings are usable; {} differ from their default\n", set_keys));
  }
}

int run(const Arguments& arguments) {
  if (arguments.task == "reference") {
    print(config::settings_reference());
    return kExitDone;
  }
  const auto loaded = load_settings(arguments.settings);
  const bool is_check = arguments.task == "check";
  if (!loaded) {
    if (is_check) print_verdict(loaded.error().text, 0, arguments.format);
    report_error(loaded.error().text);
    return is_check ? kExitFailed : kExitUsage;
  }
  const auto shown = config::show_settings(*loaded);
  if (is_check) {
    print_verdict({}, changed(shown).size(), arguments.format);
  } else {
    print_settings(arguments.task == "diff" ? changed(shown) : shown, arguments.format);
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
      "What show and diff print is itself a settings file.\n"
      "Examples:\n"
      "  stairway config show --profile depth-camera\n"
      "  stairway config check --config /etc/stairwayd/stairwayd.toml\n"
      "  stairway config diff --config robot.toml --set detector.voxel_mm=20\n"
      "Exit codes: 0 done; 1 check refuses the settings; 2 wrong usage, or settings that cannot be shown.");
  return [arguments] { return run(*arguments); };
}

}  // namespace stairway::tools
