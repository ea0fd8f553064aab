// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "config/settings.hpp"

namespace stairway::daemon {

/// The settings in effect while the daemon runs. The detector's and the log's may change; the others belong to parts
/// that were made with them.
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
