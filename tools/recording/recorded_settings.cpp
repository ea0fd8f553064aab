// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "tools/recording/recorded_settings.hpp"

#include <algorithm>
#include <set>
#include <sstream>

#include "config/settings_table.hpp"

namespace stairway::tools {
namespace {

bool decides(std::string_view key) {
  constexpr std::string_view kSections[] = {"mount.", "sweep.", "detector.", "preview."};
  return std::ranges::any_of(kSections, [&](std::string_view section) { return key.starts_with(section); });
}

std::set<std::string> known_keys() {
  config::Settings settings;
  std::set<std::string> keys;
  for (const config::Entry& entry : config::settings_table(settings)) keys.insert(entry.key);
  return keys;
}

}  // namespace

// The text is what config::to_toml() writes: sections in brackets, and "key = value" in a line of its own.
RecordedSettings recorded_settings(std::string_view toml) {
  const std::set<std::string> known = known_keys();
  RecordedSettings settings;
  std::string section;
  std::istringstream lines{std::string(toml)};
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with('[')) section = line.substr(1, line.find(']') - 1) + '.';
    const std::size_t equals = line.find(" = ");
    if (equals == std::string::npos) continue;
    const std::string key = section + line.substr(0, equals);
    if (!decides(key)) continue;
    if (known.contains(key)) {
      settings.assignments.push_back(key + "=" + line.substr(equals + 3));
    } else {
      settings.unknown_keys.push_back(key);
    }
  }
  return settings;
}

}  // namespace stairway::tools
