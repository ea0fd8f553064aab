// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <cstdio>
#include <exception>
#include <string>
#include <utility>
#include <vector>

#include "tools/stairway/report.hpp"
#include "tools/stairway/verbs.hpp"

namespace {

using namespace stairway::tools;

// Output that did not arrive, on a full disk say, must not pass for success.
int with_output_written(int exit_code) {
  if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0) return exit_code;
  report_error("cannot write to standard output");
  return kExitFailed;
}

std::string failure_text(const CLI::App* app, const CLI::Error& error) {
  const bool has_verb = !app->get_subcommands().empty();
  const std::vector<std::string> unknown = app->remaining();
  std::string what = error.what();
  if (!has_verb) what = unknown.empty() ? "a verb is required" : "there is no verb '" + unknown.front() + "'";
  const std::string verb = has_verb ? " " + app->get_subcommands().front()->get_name() : "";
  return "stairway: " + what + "\nstairway" + verb + " --help tells more\n";
}

int run(int argc, char** argv) {
  CLI::App app("Finds stairways in point clouds, simulates the scanner, and shows what stairwayd does.", "stairway");
  app.set_version_flag("--version", "stairway " STAIRWAY_VERSION);
  app.failure_message(failure_text);
  app.require_subcommand(1);
  app.get_formatter()->column_width(34);
  app.footer("stairway VERB --help tells more. Try: stairway detect sim:straight-flight");
  std::vector<std::pair<CLI::App*, Action>> actions;
  for (const Verb& verb : verbs()) {
    CLI::App* command = app.add_subcommand(verb.name, verb.summary);
    Action action = verb.declare(*command);
    actions.emplace_back(command, std::move(action));
  }
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? kExitDone : kExitUsage;
  }
  for (const auto& [command, action] : actions) {
    if (command->parsed()) return action();
  }
  return kExitUsage;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return with_output_written(run(argc, argv));
  } catch (const std::exception& error) {
    report_error(error.what());
    return kExitFailed;
  }
}
