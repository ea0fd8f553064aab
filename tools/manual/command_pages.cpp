// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "tools/manual/help_footer.hpp"
#include "tools/manual/pages.hpp"
#include "tools/manual/roff.hpp"

namespace stairway::tools {
namespace {

std::string page_name(const CommandFacts& command) {
  std::string name = command.name;
  std::replace(name.begin(), name.end(), ' ', '-');
  return name;
}

/// As the NAME line of a page wants it: without capital and full stop.
std::string summary(const CommandFacts& command) {
  std::string text = command.summary;
  if (text.ends_with('.')) text.pop_back();
  text.front() = static_cast<char>(std::tolower(static_cast<unsigned char>(text.front())));
  return text;
}

std::string synopsis(const CommandFacts& command) {
  std::string line = roff::bold(command.name);
  if (!command.verbs.empty()) return line + " " + roff::italic("VERB") + " [" + roff::italic("OPTION") + "]...\n";
  line += " [" + roff::italic("OPTION") + "]...";
  for (const OptionFacts& positional : command.positionals) {
    std::string shown = roff::italic(positional.names.front());
    if (!positional.is_required) shown = "[" + shown + "]";
    line += " " + shown + (positional.is_repeated ? "..." : "");
  }
  return line + "\n";
}

std::string term(const OptionFacts& option) {
  std::string text;
  for (const std::string& name : option.names) text += (text.empty() ? "" : ", ") + roff::bold(name);
  if (option.value.starts_with('[')) return text + "[=" + roff::italic(option.value.substr(1));
  return option.value.empty() ? text : text + " " + roff::italic(option.value);
}

std::string options(const CommandFacts& command) {
  std::string text;
  for (const OptionFacts& option : command.options) {
    const std::string value = option.default_value.empty() ? "" : fmt::format(" (default {})", option.default_value);
    text += roff::item(term(option), option.text + value);
  }
  return text;
}

std::string arguments(const CommandFacts& command) {
  std::string text;
  for (const OptionFacts& positional : command.positionals)
    text += roff::item(roff::italic(positional.names.front()), positional.text);
  return text;
}

std::string see_also(const CommandFacts& command, const CommandFacts& program) {
  std::vector<std::string> pages;
  for (const CommandFacts& verb : command.verbs) pages.push_back(roff::bold(page_name(verb)) + "(1)");
  if (&command != &program) pages.push_back(roff::bold(program.name) + "(1)");
  if (program.name != "stairwayd") pages.push_back(roff::bold("stairwayd") + "(8)");
  if (program.name != "stairway") pages.push_back(roff::bold("stairway") + "(1)");
  pages.push_back(roff::bold("stairwayd.toml") + "(5)");
  return roff::heading("SEE ALSO") + fmt::format("{}\n", fmt::join(pages, ",\n"));
}

Page page(const CommandFacts& command, const CommandFacts& program, char section, const SectionsOf& more) {
  Page page{page_name(command), section, {}};
  const HelpFooter footer = parse_footer(command.footer);
  page.text = roff::title(page.name, section) + roff::heading("NAME") + roff::text(page.name) + " \\- " +
              roff::text(summary(command)) + "\n" + roff::heading("SYNOPSIS") + synopsis(command);
  if (!footer.paragraphs.empty() || !command.positionals.empty()) page.text += roff::heading("DESCRIPTION");
  for (const std::string& paragraph : footer.paragraphs) page.text += ".PP\n" + roff::text(paragraph) + "\n";
  page.text += arguments(command);
  if (!command.verbs.empty()) page.text += roff::heading("VERBS");
  for (const CommandFacts& verb : command.verbs)
    page.text += roff::item(roff::bold(verb.name.substr(verb.name.find(' ') + 1)), verb.summary);
  page.text += roff::heading("OPTIONS") + options(command) + more(page.file_name());
  if (!footer.exit_statuses.empty()) page.text += roff::heading("EXIT STATUS");
  for (const auto& [code, meaning] : footer.exit_statuses) page.text += roff::item(roff::bold(code), meaning);
  if (!footer.examples.empty()) {
    page.text += roff::heading("EXAMPLES") + roff::example(fmt::format("{}", fmt::join(footer.examples, "\n")));
  }
  page.text += see_also(command, program);
  return page;
}

}  // namespace

std::vector<Page> command_pages(const CommandFacts& program, char section, const SectionsOf& more) {
  std::vector<Page> pages{page(program, program, section, more)};
  for (const CommandFacts& verb : program.verbs) pages.push_back(page(verb, program, section, more));
  return pages;
}

}  // namespace stairway::tools
