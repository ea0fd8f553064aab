// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sys/wait.h>

#include <array>
#include <cstdio>
#include <string>

namespace stairway::config {

struct CommandResult {
  int exit_code = -1;
  std::string output;  ///< of both streams
};

inline CommandResult run(const std::string& command) {
  CommandResult result;
  FILE* pipe = ::popen((command + " 2>&1").c_str(), "r");
  if (pipe == nullptr) return result;
  std::array<char, 4096> buffer;
  for (std::size_t got = 0; (got = std::fread(buffer.data(), 1, buffer.size(), pipe)) > 0;) {
    result.output.append(buffer.data(), got);
  }
  result.exit_code = WEXITSTATUS(::pclose(pipe));
  return result;
}

inline bool has_program(const std::string& name) { return run("command -v " + name).exit_code == 0; }

}  // namespace stairway::config
