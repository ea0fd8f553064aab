// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace stairway::tools {

/// The end of a `--help`, taken apart.
struct HelpFooter {
  std::vector<std::string> paragraphs;
  std::vector<std::string> examples;                               ///< command lines
  std::vector<std::pair<std::string, std::string>> exit_statuses;  ///< "78", "bad settings"
};

/// Reads what our footers look like: paragraphs, "Examples:" with indented lines, "Exit codes: 0 done; 1 ...".
HelpFooter parse_footer(std::string_view footer);

}  // namespace stairway::tools
