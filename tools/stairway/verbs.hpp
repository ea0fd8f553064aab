// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <span>

namespace CLI {
class App;
}

namespace stairway::tools {

/// The exit codes of every verb.
inline constexpr int kExitDone = 0;
inline constexpr int kExitFailed = 1;  ///< something could not be read, written or reached; stderr says what
inline constexpr int kExitUsage = 2;   ///< the command line or the settings are wrong

/// What a verb does after the command line has been read; answers the exit code.
using Action = std::function<int()>;

/// A verb of the command line, `stairway NAME ...`.
struct Verb {
  const char* name;
  const char* summary;
  Action (*declare)(CLI::App& command);  ///< adds the verb's options and its examples to `command`
};

Action declare_command(CLI::App& command);
Action declare_config(CLI::App& command);
Action declare_convert(CLI::App& command);
Action declare_detect(CLI::App& command);
Action declare_doctor(CLI::App& command);
Action declare_evaluate(CLI::App& command);
Action declare_info(CLI::App& command);
Action declare_monitor(CLI::App& command);
Action declare_record(CLI::App& command);
Action declare_replay(CLI::App& command);
Action declare_simulate(CLI::App& command);

/// All verbs in the order of `stairway --help`.
std::span<const Verb> verbs();

}  // namespace stairway::tools
