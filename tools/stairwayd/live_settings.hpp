// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "config/settings.hpp"

namespace stairway::daemon {

/// The settings in effect while the daemon runs. Keys of which config::changes_live() says so may change;
/// the others belong to parts that were made with them.
class LiveSettings {
 public:
  explicit LiveSettings(config::Settings settings) : settings_(std::move(settings)) {}

  /// Takes over what may change.
  /// @return The other keys whose values differ.
  std::vector<std::string> adopt(const config::Settings& wanted);

  const config::Settings& settings() const { return settings_; }

 private:
  config::Settings settings_;
};

}  // namespace stairway::daemon
