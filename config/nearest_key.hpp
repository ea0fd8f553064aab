// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "config/settings_table.hpp"

namespace stairway::config {

/// The key that was probably meant by `key`: by few edits, or the same name in another section. Empty when none is
/// near.
std::string nearest_key(std::string_view key, const std::vector<Entry>& table);

}  // namespace stairway::config
