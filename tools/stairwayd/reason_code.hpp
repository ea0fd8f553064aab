// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cctype>
#include <string>
#include <string_view>

namespace stairway::daemon {

/// The name of a trouble as programs see it: "scanner: corrupt message" is scanner:corrupt-message. docs/messages.md
/// lists them.
inline std::string reason_code(std::string_view name) {
  std::string code;
  for (std::size_t i = 0; i < name.size(); ++i) {
    if (name[i] == ' ' && i > 0 && name[i - 1] == ':') continue;
    code += name[i] == ' ' ? '-' : static_cast<char>(std::tolower(static_cast<unsigned char>(name[i])));
  }
  return code;
}

}  // namespace stairway::daemon
