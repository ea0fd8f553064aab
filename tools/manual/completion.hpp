// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "tools/manual/command_facts.hpp"

namespace stairway::tools {

/// Names that the command lines take but do not list.
struct KnownNames {
  std::vector<std::string> setting_keys;
  std::vector<std::string> profiles;
  std::vector<std::string> scenes;
  std::vector<std::string> log_levels;
};

KnownNames known_names();

/// The value of --set.
inline constexpr const char* kAssignment = "KEY=VALUE";

std::vector<std::string> with_suffix(std::vector<std::string> names, const std::string& suffix);

/// The verb without the program, e.g. "detect" of "stairway detect".
std::string verb_name(const CommandFacts& verb);

/// What may stand behind an option or as a positional; empty for files and for what nobody can know.
std::vector<std::string> values_of(const OptionFacts& option, const KnownNames& names);

/// Completion for bash, also without the package bash-completion.
/// @param script  what does the work, completion.bash, with @PROGRAM@, @HAS_VERBS@ and @ARMS@ to be filled in.
std::string bash_completion(const CommandFacts& program, const KnownNames& names, std::string script);

/// Completion for fish.
std::string fish_completion(const CommandFacts& program, const KnownNames& names);

}  // namespace stairway::tools
