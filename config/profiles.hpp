// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>
#include <utility>
#include <vector>

namespace stairway::config {

/// Name and TOML text of every file in config/profiles, compiled in.
const std::vector<std::pair<std::string_view, std::string_view>>& shipped_profiles();

}  // namespace stairway::config
