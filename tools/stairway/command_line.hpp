// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "tools/stairway/verbs.hpp"

namespace stairway::tools {

/// A verb as a part of the command line.
struct DeclaredVerb {
  CLI::App* command;
  Action action;
};

/// Adds name, verbs and help of `stairway` to `app`, which owns the commands.
std::vector<DeclaredVerb> declare_verbs(CLI::App& app);

}  // namespace stairway::tools
