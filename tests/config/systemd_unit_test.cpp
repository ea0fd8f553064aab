// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <string>

namespace stairway::config {
namespace {

struct CommandResult {
  int exit_code = -1;
  std::string output;  ///< of both streams
};

CommandResult run(const std::string& command) {
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

bool has_program(const std::string& name) { return run("command -v " + name).exit_code == 0; }

TEST(SystemdUnit, exposes_little) {
  if (!has_program("systemd-analyze")) GTEST_SKIP() << "no systemd-analyze here";
  const CommandResult result = run("systemd-analyze security --offline=true --threshold=25 " STAIRWAY_TEST_UNIT);
  EXPECT_EQ(result.exit_code, 0) << result.output;
}

TEST(SystemdUnit, holds_no_unknown_directive) {
  if (!has_program("systemd-analyze")) GTEST_SKIP() << "no systemd-analyze here";
  const CommandResult result = run("systemd-analyze verify --man=no --recursive-errors=no " STAIRWAY_TEST_UNIT);
  EXPECT_EQ(result.exit_code, 0) << result.output;
  EXPECT_EQ(result.output.find("stairwayd.service"), std::string::npos) << result.output;
}

TEST(Sysusers, makes_the_account_the_unit_runs_as) {
  if (!has_program("systemd-sysusers")) GTEST_SKIP() << "no systemd-sysusers here";
  const auto root = std::filesystem::path(testing::TempDir()) / ("sysusers_" + std::to_string(::getpid()));
  std::filesystem::create_directories(root / "etc");
  const CommandResult result =
      run("systemd-sysusers --root=" + root.string() + " " STAIRWAY_SOURCE_DIR "/systemd/stairway.sysusers");
  EXPECT_EQ(result.exit_code, 0) << result.output;
  EXPECT_EQ(run("grep -c '^stairway:' " + (root / "etc/passwd").string()).output, "1\n") << result.output;
  EXPECT_EQ(run("grep -c '^gpio:.*:stairway$' " + (root / "etc/group").string()).output, "1\n") << result.output;
  std::filesystem::remove_all(root);
}

}  // namespace
}  // namespace stairway::config
