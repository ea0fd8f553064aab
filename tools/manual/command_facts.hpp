// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace stairway::tools {

/// One option, or what stands without a name on the command line.
struct OptionFacts {
  std::vector<std::string> names;  ///< "-o", "--output"; for a positional its name alone
  std::string value;               ///< what it takes, e.g. "FILE"; empty for flags and positionals
  std::string text;
  std::string default_value;  ///< empty when it has none to tell
  bool is_required = false;
  bool is_repeated = false;
};

/// What `--help` tells of a program or of one of its verbs.
struct CommandFacts {
  std::string name;  ///< with the program's, e.g. "stairway detect"
  std::string summary;
  std::string footer;
  std::vector<OptionFacts> options;
  std::vector<OptionFacts> positionals;
  std::vector<CommandFacts> verbs;
};

CommandFacts command_facts(const CLI::App& app);

/// The alternatives of a value or a positional, e.g. {"text", "json"} of "text|json"; empty when there are none.
std::vector<std::string> alternatives(const std::string& value);

}  // namespace stairway::tools
