// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "tools/manual/command_facts.hpp"

namespace stairway::tools {

/// A manual page as a file, e.g. "stairway-detect.1".
struct Page {
  std::string name;
  char section;
  std::string text;  ///< roff with the man macros

  std::string file_name() const { return name + "." + section; }
};

/// Sections in roff that go behind the options of a page; empty for none.
using SectionsOf = std::function<std::string(const std::string& file_name)>;

/// The page of a program, followed by those of its verbs. What `--help` tells stands in them.
std::vector<Page> command_pages(const CommandFacts& program, char section, const SectionsOf& more);

/// stairwayd.toml(5): every key of the settings with its default, range and meaning.
/// @param more  sections in roff that go before the keys.
Page settings_page(const std::string& more);

}  // namespace stairway::tools
