// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include "tools/manual/completion.hpp"

namespace stairway::tools {
namespace {

std::string quoted(std::string_view text) {
  std::string result = "'";
  for (const char c : text) {
    if (c == '\'' || c == '\\') result += '\\';
    result += c;
  }
  return result + "'";
}

std::string option_line(const std::string& start, const OptionFacts& option, const KnownNames& names) {
  std::string line = start;
  for (const std::string& name : option.names)
    line += name.starts_with("--") ? " -l " + name.substr(2) : " -s " + name.substr(1);
  const std::vector<std::string> values = values_of(option, names);
  if (option.value == kAssignment) {
    line += " -x -a '$__stairway_setting_keys'";
  } else if (!values.empty()) {
    line += fmt::format(" -x -a {}", quoted(fmt::format("{}", fmt::join(values, " "))));
  } else if (!option.value.empty()) {
    line += " -r";
  }
  return fmt::format("{} -d {}\n", line, quoted(option.text));
}

std::string command_lines(const std::string& start, const CommandFacts& command, const KnownNames& names) {
  std::string text;
  for (const OptionFacts& option : command.options) text += option_line(start, option, names);
  for (const OptionFacts& positional : command.positionals) {
    const std::vector<std::string> values = values_of(positional, names);
    if (!values.empty()) text += fmt::format("{} -a {}\n", start, quoted(fmt::format("{}", fmt::join(values, " "))));
  }
  return text;
}

}  // namespace

std::string fish_completion(const CommandFacts& program, const KnownNames& names) {
  const std::string start = "complete -c " + program.name;
  std::string text =
      fmt::format("set -g __stairway_setting_keys {}\n", fmt::join(with_suffix(names.setting_keys, "="), " "));
  if (program.verbs.empty()) return text + command_lines(start, program, names);
  text += command_lines(start + " -n __fish_use_subcommand", program, names);
  for (const CommandFacts& verb : program.verbs) {
    text += fmt::format("{} -n __fish_use_subcommand -f -a {} -d {}\n", start, verb_name(verb), quoted(verb.summary));
    text += command_lines(fmt::format("{} -n '__fish_seen_subcommand_from {}'", start, verb_name(verb)), verb, names);
  }
  return text;
}

}  // namespace stairway::tools
