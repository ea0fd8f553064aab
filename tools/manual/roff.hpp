// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

namespace stairway::tools::roff {

/// Text for a manual page: nothing in it is taken for a request, and every hyphen can be copied into a shell.
std::string text(std::string_view plain);

std::string bold(std::string_view plain);
std::string italic(std::string_view plain);

/// The first line of a page, e.g. `.TH STAIRWAYD 8 ...`.
std::string title(std::string_view name, char section);

std::string heading(std::string_view plain);

/// A term and what it means; `term` is roff already.
std::string item(std::string_view term, std::string_view plain);

/// Lines that keep their breaks, indented.
std::string example(std::string_view plain);

}  // namespace stairway::tools::roff
