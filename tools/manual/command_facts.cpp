// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "tools/manual/command_facts.hpp"

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <sstream>

namespace stairway::tools {
namespace {

OptionFacts option_facts(const CLI::Option& option) {
  OptionFacts facts;
  for (const std::string& name : option.get_snames()) facts.names.push_back("-" + name);
  for (const std::string& name : option.get_lnames()) facts.names.push_back("--" + name);
  const bool takes_value = option.get_items_expected_max() > 0;
  if (takes_value) facts.value = option.get_type_name();
  facts.text = option.get_description();
  facts.default_value = option.get_default_str();
  return facts;
}

OptionFacts positional_facts(const CLI::Option& option) {
  OptionFacts facts;
  facts.names = {option.get_name(true)};
  facts.value = option.get_type_name();
  facts.text = option.get_description();
  facts.is_required = option.get_required();
  facts.is_repeated = option.get_items_expected_max() > 1;
  return facts;
}

}  // namespace

CommandFacts command_facts(const CLI::App& app) {
  CommandFacts facts;
  facts.name = app.get_parent() == nullptr ? app.get_name() : app.get_parent()->get_name() + " " + app.get_name();
  facts.summary = app.get_description();
  facts.footer = app.get_footer();
  for (const CLI::Option* option : app.get_options()) {
    if (option->get_positional()) facts.positionals.push_back(positional_facts(*option));
    if (option->nonpositional()) facts.options.push_back(option_facts(*option));
  }
  for (const CLI::App* verb : app.get_subcommands([](const CLI::App*) { return true; }))
    facts.verbs.push_back(command_facts(*verb));
  return facts;
}

std::vector<std::string> alternatives(const std::string& value) {
  std::vector<std::string> found;
  std::istringstream parts(value);
  for (std::string part; std::getline(parts, part, '|');) found.push_back(part);
  return found.size() > 1 ? found : std::vector<std::string>{};
}

}  // namespace stairway::tools
