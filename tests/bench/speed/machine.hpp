// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "tools/evaluation/experiment.hpp"

namespace stairway::bench {

/// What a figure depends on besides the program, as a table.
/// @param revision  of the sources.
evaluation::Table machine_table(const std::string& revision);

}  // namespace stairway::bench
