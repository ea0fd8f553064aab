// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <tl/expected.hpp>
#include <vector>

#include "config/settings.hpp"

namespace stairway::config {

/// `text` is one line for a person: the file with line and column (or the --set), the key, what is wrong and what was
/// expected.
struct SettingsError {
  std::string text;
};

/// Where settings come from, weakest first: the built-in defaults, the profile, the files in their order, the
/// assignments in theirs. The profile is named by the top-level key `profile` of the strongest of them.
struct SettingsSources {
  std::vector<std::filesystem::path> files;
  std::vector<std::string> assignments;  ///< "section.key=value" as TOML; quotes around texts may be left out
};

/// The files that the daemon reads, in this order: `file`, or without one /etc/stairwayd/stairwayd.toml if it exists;
/// then *.toml in the folder conf.d beside it, by name.
std::vector<std::filesystem::path> usual_files(const std::filesystem::path& file);

struct LoadedSettings {
  Settings settings;
  /// By key, where its value was set, e.g. "/etc/stairwayd/stairwayd.toml:12"; keys at their default are not in it.
  std::map<std::string, std::string> origins;
};

/// Reads, checks and merges. Unknown keys, values of the wrong kind or out of range, and combinations that a part calls
/// a problem are refused; nothing is ever ignored.
tl::expected<LoadedSettings, SettingsError> load_settings(const SettingsSources& sources);

/// One line of `stairway config`.
struct ShownSetting {
  std::string key;
  std::string value;  ///< as TOML, in the file's unit
  std::string range;  ///< for a person
  std::string doc;
  std::string origin;  ///< "default" or as in LoadedSettings
};

/// Every setting with its origin, in the order of the default file.
std::vector<ShownSetting> show_settings(const LoadedSettings& loaded);

/// The names a `profile` may have.
std::vector<std::string_view> profile_names();

}  // namespace stairway::config
