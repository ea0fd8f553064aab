// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <sstream>

#include "tests/tools/cli_process.hpp"

namespace stairway {
namespace {

using test::run_stairway;

TEST(EvaluateVerb, without_a_name_lists_the_experiments) {
  const auto text = run_stairway({"evaluate"});
  EXPECT_EQ(text.exit_code, 0);
  std::istringstream lines(run_stairway({"evaluate", "--format", "json"}).out);
  int count = 0;
  for (std::string line; std::getline(lines, line); ++count) {
    const auto experiment = nlohmann::json::parse(line);
    EXPECT_NE(text.out.find(experiment["name"].get<std::string>()), std::string::npos);
    EXPECT_FALSE(experiment["summary"].get<std::string>().empty());
  }
  EXPECT_EQ(count, std::count(text.out.begin(), text.out.end(), '\n'));
}

TEST(EvaluateVerb, trouble_is_named_and_told_by_the_exit_code) {
  const std::tuple<std::vector<std::string>, int, std::string> table[] = {
      {{"no-such-experiment"}, 2, "no-such-experiment"},
      {{"no-such-experiment"}, 2, "known are"},
      {{"all", "--share", "0"}, 2, "--share"},
      {{"all", "--share", "1.5"}, 2, "--share"},
      {{"all", "--seed", "-1"}, 2, "--seed"},
      {{"all", "--set", "detector.voxel_mm=0"}, 2, "detector.voxel_mm"},
      {{"all", "--data", "/no/such/folder"}, 1, "/no/such/folder"},
      {{"all", "--plots", "/dev/null/plots"}, 1, "/dev/null/plots"},
      {{"segmentation", "--model", "/no/such/stairs.stl"}, 1, "/no/such/stairs.stl: cannot be read"},
      {{"segmentation", "--model", "/dev/null"}, 1, "/dev/null: "},
  };
  for (const auto& [arguments, exit_code, named] : table) {
    SCOPED_TRACE(::testing::PrintToString(arguments));
    std::vector<std::string> all{"evaluate"};
    all.insert(all.end(), arguments.begin(), arguments.end());
    const auto outcome = run_stairway(all);
    EXPECT_EQ(outcome.exit_code, exit_code);
    EXPECT_NE(outcome.err.find(named), std::string::npos) << outcome.err;
    EXPECT_EQ(outcome.out, "");
  }
}

}  // namespace
}  // namespace stairway
