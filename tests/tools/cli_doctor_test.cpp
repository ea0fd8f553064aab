// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdlib>
#include <nlohmann/json.hpp>

#include "tests/tools/temporary_folder.hpp"

namespace stairway {
namespace {

/// Runs `stairway doctor` in a network namespace of its own, so that nothing leaves this host.
int run_doctor(const std::string& arguments, const std::string& out) {
  const std::string command = "unshare -n " STAIRWAY " doctor " + arguments + " >" + out + " 2>/dev/null";
  return WEXITSTATUS(std::system(command.c_str()));
}

bool has_namespaces() { return std::system("unshare -n true 2>/dev/null") == 0; }

TEST(DoctorVerb, answers_with_one_json_object_whatever_the_machine_lacks) {
  if (!has_namespaces()) GTEST_SKIP() << "no network namespaces here";
  const test::TemporaryFolder folder;
  const int exit_code = run_doctor("--format json", folder.path("out"));
  const auto answer = nlohmann::json::parse(test::read_text(folder.path("out")));
  EXPECT_EQ(answer["state"], "failure") << "there is no multicast route in the namespace";
  EXPECT_EQ(exit_code, 2);
  EXPECT_EQ(answer["checks"][0]["name"], "settings");
  for (const auto& check : answer["checks"]) {
    EXPECT_FALSE(check["text"].get<std::string>().empty()) << check;
    const std::string state = check["state"];
    EXPECT_EQ(check["remedy"].get<std::string>().empty(), state == "ok" || state == "skipped") << check;
  }
}

TEST(DoctorVerb, names_file_line_and_key_of_bad_settings) {
  if (!has_namespaces()) GTEST_SKIP() << "no network namespaces here";
  const test::TemporaryFolder folder;
  test::write_text(folder.path("bad.toml"), "[lidar]\nclusterr = 3\n");
  EXPECT_EQ(run_doctor("--config " + folder.path("bad.toml"), folder.path("out")), 2);
  const std::string out = test::read_text(folder.path("out"));
  EXPECT_EQ(out.find("failure  settings"), 0U) << out;
  EXPECT_NE(out.find("bad.toml:2:1: unknown key 'lidar.clusterr'"), std::string::npos) << out;
}

}  // namespace
}  // namespace stairway
