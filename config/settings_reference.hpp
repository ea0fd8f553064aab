// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace stairway::config {

/// The text of docs/settings.md, in Markdown: every key with default, values, meaning and when a change takes effect.
std::string settings_reference();

}  // namespace stairway::config
