// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "tools/stairwayd/live_settings.hpp"

#include <cstddef>

#include "config/settings_table.hpp"

namespace stairway::daemon {

std::vector<std::string> LiveSettings::adopt(const config::Settings& wanted) {
  settings_.detector = wanted.detector;
  settings_.log = wanted.log;
  config::Settings copy = wanted;
  const std::vector<config::Entry> now = config::settings_table(settings_), then = config::settings_table(copy);
  std::vector<std::string> keys;
  for (std::size_t i = 0; i < now.size(); ++i) {
    if (config::show_value(now[i]) != config::show_value(then[i])) keys.push_back(now[i].key);
  }
  return keys;
}

}  // namespace stairway::daemon
