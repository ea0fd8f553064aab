// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "tools/stairway/command_line.hpp"

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <string>
#include <utility>

namespace stairway::tools {
namespace {

std::string failure_text(const CLI::App* app, const CLI::Error& error) {
  const bool has_verb = !app->get_subcommands().empty();
  const std::vector<std::string> unknown = app->remaining();
  std::string what = error.what();
  if (!has_verb) what = unknown.empty() ? "a verb is required" : "there is no verb '" + unknown.front() + "'";
  const std::string verb = has_verb ? " " + app->get_subcommands().front()->get_name() : "";
  return "stairway: " + what + "\nstairway" + verb + " --help tells more\n";
}

}  // namespace

std::vector<DeclaredVerb> declare_verbs(CLI::App& app) {
  app.name("stairway");
  app.description("Finds stairways in point clouds, simulates the scanner, and shows what stairwayd does.");
  app.set_version_flag("--version", "stairway " STAIRWAY_VERSION);
  app.failure_message(failure_text);
  app.require_subcommand(1);
  app.get_formatter()->column_width(34);
  app.footer("stairway VERB --help tells more. Try: stairway detect sim:straight-flight");
  std::vector<DeclaredVerb> declared;
  for (const Verb& verb : verbs()) {
    CLI::App* command = app.add_subcommand(verb.name, verb.summary);
    declared.push_back({command, verb.declare(*command)});
  }
  return declared;
}

}  // namespace stairway::tools
