// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace stairway::daemon {

/// What the command line of stairwayd says.
struct CommandLine {
  std::string config;
  std::vector<std::string>
      assignments;  ///< of --set, --source, --simulate and --log-level, in the order in which they count
  std::string replay;
  bool is_check = false;
  bool is_once = false;
};

/// Adds name, options and help of stairwayd to `app`; `line` is filled when the command line is read and must live
/// until then.
void declare_options(CLI::App& app, CommandLine& line);

}  // namespace stairway::daemon
