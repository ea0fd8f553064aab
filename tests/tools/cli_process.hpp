// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace stairway::test {

/// What one run of the program left behind.
struct Outcome {
  int exit_code = -1;
  std::string out;
  std::string err;
};

/// Runs `stairway` with these arguments, without a shell, to its end.
Outcome run_stairway(const std::vector<std::string>& arguments);

}  // namespace stairway::test
