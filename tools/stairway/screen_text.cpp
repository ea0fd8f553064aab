// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "tools/stairway/screen_text.hpp"

#include <algorithm>

namespace stairway::tools {
namespace {

bool is_continuation(char c) { return (static_cast<unsigned char>(c) & 0xC0) == 0x80; }

bool is_control(char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7f; }

std::size_t width(std::string_view text) {
  return static_cast<std::size_t>(std::ranges::count_if(text, [](char c) { return !is_continuation(c); }));
}

/// Where the first `columns` characters end.
std::size_t end_of(std::string_view text, std::size_t columns) {
  std::size_t at = 0;
  for (std::size_t characters = 0; at < text.size(); ++at) {
    if (!is_continuation(text[at]) && characters++ == columns) break;
  }
  return at;
}

}  // namespace

std::string clipped(std::string_view text, std::size_t columns) {
  std::string out(text.substr(0, end_of(text, columns)));
  std::ranges::replace_if(out, is_control, ' ');
  return out;
}

std::string padded(std::string_view text, std::size_t columns) {
  std::string out = clipped(text, columns);
  out.append(columns - width(out), ' ');
  return out;
}

std::string beside(std::string_view left, std::string_view right, std::size_t columns) {
  const std::size_t needed = width(right) + 2;
  if (columns < needed + 20) return clipped(left, columns);
  return padded(left, columns - needed) + "  " + std::string(right);
}

std::vector<std::string> wrapped(std::string_view text, std::size_t columns, std::size_t lines) {
  std::vector<std::string> out;
  while (out.size() + 1 < lines && width(text) > columns) {
    const std::size_t limit = end_of(text, columns);
    const std::size_t space = text.substr(0, limit + 1).rfind(' ');
    const bool is_between_words = space != std::string_view::npos && space > 0;
    out.push_back(clipped(text.substr(0, is_between_words ? space : limit), columns));
    text.remove_prefix(is_between_words ? space + 1 : limit);
  }
  out.push_back(clipped(text, columns));
  return out;
}

}  // namespace stairway::tools
