// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "tools/manual/completion.hpp"

#include "config/load_settings.hpp"
#include "config/settings_table.hpp"
#include "tools/sim/scene_file.hpp"

namespace stairway::tools {
namespace {

std::vector<std::string> with_prefix(const std::string& prefix, const std::vector<std::string>& names) {
  std::vector<std::string> result;
  for (const std::string& name : names) result.push_back(prefix + name);
  return result;
}

}  // namespace

KnownNames known_names() {
  KnownNames names;
  config::Settings defaults;
  for (const config::Entry& entry : config::settings_table(defaults)) {
    names.setting_keys.push_back(entry.key);
    if (entry.key == "log.level") names.log_levels = std::get<config::ChoiceField>(entry.field).names;
  }
  for (const std::string_view name : config::profile_names()) names.profiles.emplace_back(name);
  for (const std::string& name : sim::shipped_scene_names()) {
    // A random one wants its seed, which nobody can complete.
    if (name.find(':') == std::string::npos) names.scenes.push_back(name);
  }
  return names;
}

std::vector<std::string> with_suffix(std::vector<std::string> names, const std::string& suffix) {
  for (std::string& name : names) name += suffix;
  return names;
}

std::string verb_name(const CommandFacts& verb) { return verb.name.substr(verb.name.find(' ') + 1); }

std::vector<std::string> values_of(const OptionFacts& option, const KnownNames& names) {
  const std::string& name = option.names.back();
  if (option.value == kAssignment) return with_suffix(names.setting_keys, "=");
  if (name == "--profile") return names.profiles;
  if (name == "--log-level") return names.log_levels;
  if (name == "SCENE" || option.value == "[SCENE]") return names.scenes;
  if (name == "SOURCE" || option.value == "sim:SCENE") return with_prefix("sim:", names.scenes);
  return alternatives(option.value);
}

}  // namespace stairway::tools
