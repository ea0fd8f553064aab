// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

namespace stairway::test {
namespace {

namespace fs = std::filesystem;

std::string read(const fs::path& file) {
  std::ifstream stream(file);
  std::ostringstream text;
  text << stream.rdbuf();
  return text.str();
}

/// All sources of the programs, with strings that go over several lines joined.
std::string sources() {
  std::string text;
  for (const char* folder : {"config", "drivers", "ipc", "scan_assembly", "tools"}) {
    for (const auto& entry : fs::recursive_directory_iterator(fs::path(STAIRWAY_SOURCE_DIR) / folder)) {
      const fs::path extension = entry.path().extension();
      if (extension == ".cpp" || extension == ".hpp") text += read(entry.path());
    }
  }
  return std::regex_replace(text, std::regex("\"\\s*\n\\s*\""), "");
}

/// What stands between the dots that leave out what differs.
std::vector<std::string> fixed_parts(std::string message) {
  static const std::string kDots = "…";
  std::vector<std::string> parts;
  for (std::size_t at = 0; !message.empty(); message.erase(0, at + kDots.size())) {
    at = std::min(message.find(kDots), message.size());
    if (at > 0) parts.push_back(message.substr(0, at));
    if (at == message.size()) break;
  }
  return parts;
}

/// The messages in the tables of the page, in order.
std::vector<std::string> quoted_messages() {
  std::istringstream lines(read(STAIRWAY_SOURCE_DIR "/docs/operation.md"));
  std::vector<std::string> messages;
  bool is_table = false;
  for (std::string line; std::getline(lines, line);) {
    is_table = line.starts_with("| message |") || (is_table && line.starts_with("|"));
    if (is_table && line.starts_with("| `")) messages.push_back(line.substr(3, line.find("` |") - 3));
  }
  return messages;
}

TEST(OperationPage, quotes_only_what_the_programs_say) {
  const std::string text = sources();
  ASSERT_GT(quoted_messages().size(), 20u);
  for (const std::string& message : quoted_messages()) {
    for (const std::string& part : fixed_parts(message))
      EXPECT_NE(text.find(part), std::string::npos) << "\"" << part << "\" of: " << message;
  }
}

}  // namespace
}  // namespace stairway::test
