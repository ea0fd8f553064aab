// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <string>

#include "tests/config/command.hpp"

namespace stairway::config {
namespace {

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
