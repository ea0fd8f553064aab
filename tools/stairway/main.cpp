// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <cstdio>
#include <exception>
#include <vector>

#include "tools/stairway/command_line.hpp"
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

int run(int argc, char** argv) {
  CLI::App app;
  const std::vector<DeclaredVerb> declared = declare_verbs(app);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? kExitDone : kExitUsage;
  }
  for (const DeclaredVerb& verb : declared) {
    if (verb.command->parsed()) return verb.action();
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
