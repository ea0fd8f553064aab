// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "tools/manual/help_footer.hpp"

#include <cctype>
#include <sstream>

namespace stairway::tools {
namespace {

constexpr std::string_view kExamples = "Examples:";
constexpr std::string_view kExitCodes = "Exit codes:";

bool is_digit(char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; }

/// "0 done; 1 failed, or nothing came; still done" into its codes; a part without a number belongs to the one before.
std::vector<std::pair<std::string, std::string>> exit_statuses(std::string text) {
  if (text.ends_with('.')) text.pop_back();
  std::vector<std::pair<std::string, std::string>> found;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find("; ", begin), text.size());
    const std::string part = text.substr(begin, end - begin);
    const std::size_t space = part.find(' ');
    if (is_digit(part.front()) && space != std::string::npos) {
      found.emplace_back(part.substr(0, space), part.substr(space + 1));
    } else if (!found.empty()) {
      found.back().second += "; " + part;
    }
    begin = end + 2;
  }
  return found;
}

void append(std::string& paragraph, std::string_view line) {
  if (!paragraph.empty()) paragraph += ' ';
  paragraph += line;
}

}  // namespace

HelpFooter parse_footer(std::string_view footer) {
  HelpFooter result;
  std::string paragraph, codes;
  const auto end_paragraph = [&] {
    if (!paragraph.empty()) result.paragraphs.push_back(std::exchange(paragraph, {}));
  };
  std::string* part = &paragraph;
  std::istringstream lines{std::string(footer)};
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with(kExamples)) {
      part = nullptr;
    } else if (line.starts_with(kExitCodes)) {
      part = &codes;
      append(codes, line.substr(kExitCodes.size() + 1));
    } else if (line.empty()) {
      end_paragraph();
      part = &paragraph;
    } else if (part == nullptr && line.starts_with("  ")) {
      result.examples.push_back(line.substr(2));
    } else {
      if (part == nullptr) part = &paragraph;
      append(*part, line);
    }
  }
  end_paragraph();
  result.exit_statuses = exit_statuses(codes);
  return result;
}

}  // namespace stairway::tools
