// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

/// Texts of other programs on a terminal. Characters are counted, not bytes (UTF-8); control characters become spaces,
/// so that no text can steer the terminal.
namespace stairway::tools {

/// At most `columns` characters of it.
std::string clipped(std::string_view text, std::size_t columns);

/// Exactly `columns` characters: clipped, or with spaces behind it.
std::string padded(std::string_view text, std::size_t columns);

/// `right` at the end of a line of `columns` characters; left out when there is no room for it beside `left`.
std::string beside(std::string_view left, std::string_view right, std::size_t columns);

/// Broken between words into at most `lines` lines of at most `columns` characters; at least one line.
std::vector<std::string> wrapped(std::string_view text, std::size_t columns, std::size_t lines);

}  // namespace stairway::tools
