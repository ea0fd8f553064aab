// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "tools/manual/roff.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

namespace stairway::tools::roff {

std::string text(std::string_view plain) {
  std::string result;
  bool is_line_start = true;
  for (const char c : plain) {
    if (is_line_start && (c == '.' || c == '\'')) result += "\\&";
    if (c == '\\') {
      result += "\\e";
    } else if (c == '-') {
      result += "\\-";
    } else {
      result += c;
    }
    is_line_start = c == '\n';
  }
  return result;
}

std::string bold(std::string_view plain) { return "\\fB" + text(plain) + "\\fR"; }
std::string italic(std::string_view plain) { return "\\fI" + text(plain) + "\\fR"; }

std::string title(std::string_view name, char section) {
  std::string upper(name);
  std::transform(upper.begin(), upper.end(), upper.begin(),
                 [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  return fmt::format(".TH {} {} \"\" \"stairwayd {}\"\n", text(upper), section, STAIRWAY_VERSION);
}

std::string heading(std::string_view plain) { return fmt::format(".SH {}\n", text(plain)); }

std::string item(std::string_view term, std::string_view plain) {
  return fmt::format(".TP\n{}\n{}\n", term, text(plain));
}

std::string example(std::string_view plain) { return fmt::format(".PP\n.RS 4\n.nf\n{}\n.fi\n.RE\n", text(plain)); }

}  // namespace stairway::tools::roff
