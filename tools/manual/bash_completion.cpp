// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include "tools/manual/completion.hpp"

namespace stairway::tools {
namespace {

std::string arm(const std::string& pattern, const std::vector<std::string>& words) {
  const std::string answer = words.empty() ? "" : fmt::format(" echo '{}'", fmt::join(words, " "));
  return fmt::format("    {}){} ;;\n", pattern, answer);
}

/// The arms of a case for one command: behind its options that take a value, and anywhere else.
std::string arms(const CommandFacts& command, const KnownNames& names) {
  std::string text;
  std::vector<std::string> anywhere;
  for (const OptionFacts& option : command.options) {
    anywhere.insert(anywhere.end(), option.names.begin(), option.names.end());
    if (option.value.empty() || option.value == kAssignment) continue;
    for (const std::string& name : option.names)
      text += arm(fmt::format("'{} {}'", command.name, name), values_of(option, names));
  }
  for (const OptionFacts& positional : command.positionals) {
    const std::vector<std::string> values = values_of(positional, names);
    anywhere.insert(anywhere.end(), values.begin(), values.end());
  }
  for (const CommandFacts& verb : command.verbs) anywhere.push_back(verb_name(verb));
  return text + arm(fmt::format("'{} '*", command.name), anywhere);
}

void replace_all(std::string& text, std::string_view what, std::string_view by) {
  for (std::size_t at = 0; (at = text.find(what, at)) != std::string::npos; at += by.size())
    text.replace(at, what.size(), by);
}

}  // namespace

std::string bash_completion(const CommandFacts& program, const KnownNames& names, std::string script) {
  std::string cases = arm("*' --set'", with_suffix(names.setting_keys, "="));
  for (const CommandFacts& verb : program.verbs) cases += arms(verb, names);
  cases += arms(program, names);
  cases.pop_back();
  replace_all(script, "@PROGRAM@", program.name);
  replace_all(script, "@HAS_VERBS@", program.verbs.empty() ? "0" : "1");
  replace_all(script, "@ARMS@", cases);
  return script;
}

}  // namespace stairway::tools
