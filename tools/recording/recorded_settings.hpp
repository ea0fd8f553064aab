// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace stairway::tools {

/// The settings of a recording that decide what is found in it.
struct RecordedSettings {
  std::vector<std::string> assignments;   ///< "section.key=value", as config::load_settings takes them
  std::vector<std::string> unknown_keys;  ///< this version has no such keys; they were left out
};

/// Takes mount, sweep, detector and preview from the text of a settings message; where messages go, what is recorded
/// and so on is the affair of whoever plays it.
RecordedSettings recorded_settings(std::string_view toml);

}  // namespace stairway::tools
