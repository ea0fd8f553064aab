// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "drivers/scip/scip_commands.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace stairway::drivers {
namespace {

TEST(ScipCommands, build_and_parse_the_same_text) {
  struct Case {
    std::string text;
    ScanRequest request;
  };
  for (const auto& [text, request] : std::vector<Case>{{"MD0000108001000", {"MD", 0, 1080, 1, 0, 0}},
                                                       {"ME0532054701100", {"ME", 532, 547, 1, 1, 0}},
                                                       {"MS0044072503905", {"MS", 44, 725, 3, 9, 5}},
                                                       {"GD0000108002", {"GD", 0, 1080, 2, 0, 0}}}) {
    SCOPED_TRACE(text);
    EXPECT_EQ(to_command(request), text);
    const auto command = parse_command(text);
    ASSERT_TRUE(command);
    EXPECT_EQ(parse_scan_request(*command), request);
  }
}

TEST(ScipCommands, split_symbol_parameters_and_tag) {
  const auto command = parse_command("MD0000108001000;turn_7@.+ ");
  ASSERT_TRUE(command);
  EXPECT_EQ(command->symbol, "MD");
  EXPECT_EQ(command->parameters, "0000108001000");
  EXPECT_EQ(command->tag, "turn_7@.+ ");
  EXPECT_EQ(parse_command("SCIP2.0")->symbol, "SCIP2.0");
  EXPECT_EQ(parse_command("VV")->parameters, "");
}

TEST(ScipCommands, refuse_what_is_no_command) {
  for (const std::string line : {"", "V", ";tag", "VV;seventeen_letters", "VV;a#b"}) {
    SCOPED_TRACE(line);
    EXPECT_FALSE(parse_command(line));
  }
}

TEST(ScipCommands, refuse_requests_of_another_length_or_with_letters) {
  for (const std::string line : {"MD000010800100", "MD00001080010000", "MDx000108001000", "GD0000108001000", "VV"}) {
    SCOPED_TRACE(line);
    const auto command = parse_command(line);
    ASSERT_TRUE(command);
    EXPECT_FALSE(parse_scan_request(*command));
  }
}

TEST(ScipCommands, count_values_of_whole_and_partial_groups) {
  const ScanRequest whole{"MD", 0, 1080, 1, 0, 0};
  EXPECT_EQ(whole.min_values(), 1081);
  EXPECT_EQ(whole.max_values(), 1081);
  const ScanRequest partial{"MD", 0, 1080, 4, 0, 0};
  EXPECT_EQ(partial.min_values(), 270);
  EXPECT_EQ(partial.max_values(), 271);
  EXPECT_EQ((ScanRequest{"MD", 5, 5, 0, 0, 0}.max_values()), 1);
}

}  // namespace
}  // namespace stairway::drivers
