// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <tl/expected.hpp>
#include <vector>

#include "config/load_settings.hpp"
#include "tools/stairway/report.hpp"

namespace CLI {
class App;
}

namespace stairway::tools {

/// Where a verb gets its settings from: --config, --set and --profile.
struct SettingsArguments {
  std::vector<std::string> files;
  std::vector<std::string> assignments;
  std::string profile;
};

/// @param arguments  filled when the command line is read; must live until then.
void add_settings_options(CLI::App& command, SettingsArguments& arguments);
void add_format_option(CLI::App& command, Format& format);

/// The same with the files that a daemon with this --config reads: without one its usual file, and in either case the
/// folder conf.d beside the first.
SettingsArguments as_the_daemon(SettingsArguments arguments);

tl::expected<config::LoadedSettings, config::SettingsError> load_settings(const SettingsArguments& arguments);

}  // namespace stairway::tools
