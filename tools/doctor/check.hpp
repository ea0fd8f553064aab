// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace stairway::doctor {

enum class State : std::uint8_t {
  Ok,
  Warning,  ///< works, or may work, but not as well as it could
  Failure,  ///< does not work
  Skipped,  ///< could not be looked at; the text says why. Not a fault
};
const char* to_string(State state);

/// One thing that was looked at.
struct Check {
  std::string name;  ///< stable, for programs, e.g. "scanner-access"
  State state = State::Ok;
  std::string text;    ///< one line: what was found
  std::string remedy;  ///< one line: what to do; empty when there is nothing to do
};

Check ok(std::string name, std::string text);
Check skipped(std::string name, std::string text);
Check warning(std::string name, std::string text, std::string remedy);
Check failure(std::string name, std::string text, std::string remedy);

/// 0 all is well, 1 there are warnings, 2 there are failures.
int exit_code(std::span<const Check> checks);

/// One line each, ended by LF: state, name, what was found and what to do.
std::string to_text(std::span<const Check> checks);

/// One object on one line, without LF: `{"state": ..., "checks": [{"name", "state", "text", "remedy"}]}`, where the
/// outer state is the worst of all.
std::string to_json(std::span<const Check> checks);

}  // namespace stairway::doctor
