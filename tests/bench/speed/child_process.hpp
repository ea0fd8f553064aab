// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace stairway::bench {

/// A program that has ended well.
struct ChildRun {
  std::string output;  ///< of its standard output
  double wall_ms = 0.0;
  double cpu_ms = 0.0;   ///< its own and the kernel's for it
  double peak_MB = 0.0;  ///< resident, but never below what this process holds: Linux begins to count before exec
};

/// Runs a program to its end; its standard error is that of this process. Throws std::runtime_error with the command
/// when it cannot be run or does not exit with 0.
ChildRun run_child(const std::vector<std::string>& command);

}  // namespace stairway::bench
