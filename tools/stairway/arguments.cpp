// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "tools/stairway/arguments.hpp"

#include <fmt/format.h>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <filesystem>

namespace stairway::tools {

void add_settings_options(CLI::App& command, SettingsArguments& arguments) {
  command.add_option("--config", arguments.files, "settings file; may be repeated, later ones win")
      ->type_name("FILE")
      ->allow_extra_args(false);
  command.add_option("--set", arguments.assignments, "one setting, e.g. detector.voxel_mm=20; may be repeated")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);
  command
      .add_option("--profile", arguments.profile,
                  fmt::format("set of defaults: {}", fmt::join(config::profile_names(), " or ")))
      ->type_name("NAME");
}

void add_format_option(CLI::App& command, Format& format) {
  const auto choose = [&format](const std::string& name) { format = name == "json" ? Format::Json : Format::Text; };
  command.add_option_function<std::string>("--format", choose, "text for people (default) or json for programs")
      ->check(CLI::IsMember({"text", "json"}).description(""))
      ->type_name("text|json");
}

SettingsArguments as_the_daemon(SettingsArguments arguments) {
  const auto usual = config::usual_files(arguments.files.empty() ? "" : arguments.files.front());
  if (!arguments.files.empty()) arguments.files.erase(arguments.files.begin());
  std::vector<std::string> files;
  for (const std::filesystem::path& file : usual) files.push_back(file.string());
  arguments.files.insert(arguments.files.begin(), files.begin(), files.end());
  return arguments;
}

tl::expected<config::LoadedSettings, config::SettingsError> load_settings(const SettingsArguments& arguments) {
  config::SettingsSources sources{.assignments = arguments.assignments};
  sources.files.assign(arguments.files.begin(), arguments.files.end());
  if (!arguments.profile.empty()) sources.assignments.push_back("profile=" + arguments.profile);
  return config::load_settings(sources);
}

}  // namespace stairway::tools
