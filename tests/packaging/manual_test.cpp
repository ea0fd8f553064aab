// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <set>
#include <sstream>

#include "config/settings_table.hpp"
#include "tests/config/command.hpp"

namespace stairway::test {
namespace {

using config::has_program;
using config::run;

std::string read(const std::string& file) {
  std::ifstream stream(std::string(STAIRWAY_MANUAL) + "/" + file);
  EXPECT_TRUE(stream) << file;
  std::ostringstream text;
  text << stream.rdbuf();
  return text.str();
}

/// A page as it is written, with the hyphens that a reader sees.
std::string page(const std::string& file) {
  std::string text = read("man/man" + file.substr(file.rfind('.') + 1) + "/" + file);
  for (std::size_t at = 0; (at = text.find("\\-", at)) != std::string::npos;) text.erase(at, 1);
  return text;
}

/// The first words of the indented lines below a heading of a help text.
std::set<std::string> listed(const std::string& help, const std::string& heading) {
  std::set<std::string> words;
  std::istringstream lines(help.substr(std::min(help.find(heading + ":\n"), help.size())));
  std::string line;
  std::getline(lines, line);
  while (std::getline(lines, line) && line.starts_with("  ")) {
    if (line[2] != ' ') words.insert(line.substr(2, line.find_first_of(" ,", 2) - 2));
    if (line.starts_with("  -") && line.find(",--") != std::string::npos) {
      const std::size_t at = line.find(",--") + 1;
      words.insert(line.substr(at, line.find(' ', at) - at));
    }
  }
  return words;
}

struct Command {
  std::string name;
  std::string program;
  std::string page;
};

/// The programs and every verb that `stairway --help` names.
std::vector<Command> commands() {
  std::vector<Command> all{{"stairwayd", STAIRWAYD, "stairwayd.8"}, {"stairway", STAIRWAY, "stairway.1"}};
  for (const std::string& verb : listed(run(STAIRWAY " --help").output, "Subcommands"))
    all.push_back({"stairway " + verb, STAIRWAY " " + verb, "stairway-" + verb + ".1"});
  return all;
}

TEST(Manual, has_a_page_with_every_option_of_every_verb) {
  ASSERT_GT(commands().size(), 10u);
  for (const Command& command : commands()) {
    SCOPED_TRACE(command.name);
    const std::set<std::string> options = listed(run(command.program + " --help").output, "Options");
    ASSERT_TRUE(options.contains("--help"));
    const std::string text = page(command.page);
    for (const std::string& option : options)
      EXPECT_NE(text.find("\\fB" + option + "\\fR"), std::string::npos) << option;
  }
}

TEST(Manual, names_every_verb_and_has_its_exit_codes_and_an_example) {
  const std::string overview = page("stairway.1");
  for (const Command& command : commands()) {
    SCOPED_TRACE(command.name);
    const std::size_t space = command.name.find(' ');
    const bool is_named = overview.find("\\fB" + command.name.substr(space + 1) + "\\fR") != std::string::npos;
    EXPECT_TRUE(is_named || space == std::string::npos);
    if (command.name == "stairway") continue;
    const std::string text = page(command.page);
    EXPECT_NE(text.find(".SH EXIT STATUS\n.TP\n\\fB0\\fR"), std::string::npos);
    EXPECT_NE(text.find(".SH EXAMPLES\n"), std::string::npos);
  }
}

TEST(Manual, has_every_key_of_the_settings_with_its_meaning) {
  const std::string text = page("stairwayd.toml.5");
  config::Settings defaults;
  for (const config::Entry& entry : config::settings_table(defaults)) {
    EXPECT_NE(text.find("\\fB" + entry.key + "\\fR = "), std::string::npos) << entry.key;
    EXPECT_NE(text.find(entry.doc), std::string::npos) << entry.doc;
  }
}

TEST(Manual, is_set_without_complaint) {
  if (!has_program("groff")) GTEST_SKIP() << "no groff here";
  for (const Command& command : commands()) {
    const std::string file = STAIRWAY_MANUAL "/man/man" + command.page.substr(command.page.rfind('.') + 1) + "/";
    EXPECT_EQ(run("groff -man -ww -z -Tutf8 -rLL=80n " + file + command.page).output, "") << command.page;
  }
  EXPECT_EQ(run("groff -man -ww -z -Tutf8 " STAIRWAY_MANUAL "/man/man5/stairwayd.toml.5").output, "");
}

/// What bash offers for words of a command line, the last of them unfinished; sorted.
std::set<std::string> completions(const std::string& program, const std::string& words) {
  const std::string script = "source " STAIRWAY_MANUAL "/bash/" + program + " && COMP_WORDS=(" + words +
                             ") && COMP_CWORD=$((${#COMP_WORDS[@]} - 1)) && _" + program +
                             "; printf \"%s\\n\" \"${COMPREPLY[@]}\"";
  std::istringstream lines(run("bash -c '" + script + "'").output);
  std::set<std::string> offered;
  for (std::string line; std::getline(lines, line);) {
    if (!line.empty()) offered.insert(line);
  }
  return offered;
}

TEST(BashCompletion, offers_every_option_that_the_help_tells) {
  for (const Command& command : commands()) {
    SCOPED_TRACE(command.name);
    const std::string program = command.name.substr(0, command.name.find(' '));
    const std::set<std::string> offered = completions(program, command.name + " -");
    EXPECT_EQ(offered, listed(run(command.program + " --help").output, "Options"));
  }
}

TEST(BashCompletion, offers_what_fits) {
  using Words = std::set<std::string>;
  struct Case {
    std::string program, words;
    Words offered;
  };
  // As bash cuts them: = and : are words of their own.
  for (const Case& c : {
           Case{"stairway", "stairway det", {"detect"}},
           Case{"stairway", "stairway detect --format j", {"json"}},
           Case{"stairway", "stairway detect --format = te", {"text"}},
           Case{"stairway", "stairway detect --set detector.voxel_mm", {"detector.voxel_mm="}},
           Case{"stairway", "stairway detect --set disk.period_s = 1", {}},
           Case{"stairway", "stairway detect --config rob", {}},
           Case{"stairway", "stairway detect sim : spi", {"spiral"}},
           Case{"stairway", "stairway detect stairs : spi", {}},
           Case{"stairway", "stairway config d", {"diff"}},
           Case{"stairwayd", "stairwayd --simulate = emp", {"empty-room"}},
           Case{"stairwayd", "stairwayd --log-level w", {"warning"}},
           Case{"stairwayd", "stairwayd --che", {"--check-config"}},
       }) {
    SCOPED_TRACE(c.words);
    EXPECT_EQ(completions(c.program, c.words), c.offered);
  }
}

TEST(BashCompletion, lists_scenes_behind_a_colon) {
  EXPECT_TRUE(completions("stairway", "stairway monitor --truth sim :").contains("straight-flight"));
}

TEST(FishCompletion, knows_every_option_that_the_help_tells) {
  for (const Command& command : commands()) {
    SCOPED_TRACE(command.name);
    const std::size_t space = command.name.find(' ');
    const std::string text = read("fish/" + command.name.substr(0, space) + ".fish");
    const std::string condition = space == std::string::npos ? "" : "_from " + command.name.substr(space + 1) + "'";
    for (const std::string& option : listed(run(command.program + " --help").output, "Options")) {
      const bool is_long = option.starts_with("--");
      const std::string wanted = is_long ? " -l " + option.substr(2) + " " : " -s " + option.substr(1) + " ";
      std::istringstream lines(text);
      bool is_found = false;
      for (std::string line; std::getline(lines, line);)
        is_found = is_found || (line.find(condition) != std::string::npos && line.find(wanted) != std::string::npos);
      EXPECT_TRUE(is_found) << option;
    }
  }
}

}  // namespace
}  // namespace stairway::test
