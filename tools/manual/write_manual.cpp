// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
// Writes the manual pages and the completions of bash and fish into a folder, from what the programs themselves say.
#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>

#include "tools/manual/completion.hpp"
#include "tools/manual/pages.hpp"
#include "tools/stairway/command_line.hpp"
#include "tools/stairwayd/command_line.hpp"

namespace {

using namespace stairway::tools;
namespace fs = std::filesystem;

std::string read(const fs::path& file) {
  std::ifstream stream(file);
  std::ostringstream text;
  text << stream.rdbuf();
  return text.str();
}

void write(const fs::path& file, const std::string& text) {
  fs::create_directories(file.parent_path());
  std::ofstream stream(file);
  stream << text;
  stream.close();
  if (!stream) throw std::runtime_error("cannot write " + file.string());
}

CommandFacts stairwayd_facts() {
  CLI::App app;
  stairway::daemon::CommandLine line;
  stairway::daemon::declare_options(app, line);
  return command_facts(app);
}

CommandFacts stairway_facts() {
  CLI::App app;
  const auto declared = declare_verbs(app);
  return command_facts(app);
}

/// @param sources  the folder of this file, with the parts of the manual that are written by hand.
void write_manual(const fs::path& sources, const fs::path& folder) {
  const auto sections = [&](const std::string& file_name) { return read(sources / "sections" / file_name); };
  const CommandFacts daemon = stairwayd_facts(), companion = stairway_facts();
  std::vector<Page> pages = command_pages(companion, '1', sections);
  pages.push_back(command_pages(daemon, '8', sections).front());
  pages.push_back(settings_page(sections("stairwayd.toml.5")));
  for (const Page& page : pages)
    write(folder / "man" / (std::string("man") + page.section) / page.file_name(), page.text);
  const std::string script = read(sources / "completion.bash");
  for (const CommandFacts& program : {daemon, companion}) {
    write(folder / "bash" / program.name, bash_completion(program, known_names(), script));
    write(folder / "fish" / (program.name + ".fish"), fish_completion(program, known_names()));
  }
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) {
    std::fputs("usage: write_manual SOURCES FOLDER\n", stderr);
    return 2;
  }
  try {
    write_manual(argv[1], argv[2]);
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "write_manual: %s\n", error.what());
    return 1;
  }
}
