// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "tools/manual/help_footer.hpp"

#include <gtest/gtest.h>

namespace stairway::tools {
namespace {

using Strings = std::vector<std::string>;
using Codes = std::vector<std::pair<std::string, std::string>>;

TEST(HelpFooter, is_taken_apart_in_any_order) {
  const HelpFooter footer = parse_footer(
      "Tells a\nlot.\n\nAnd more.\nExit codes: 0 done; 1 failed (the others\nare done); still; 78 bad.\n\n"
      "Examples:\n  a --b\n  c | d");
  EXPECT_EQ(footer.paragraphs, (Strings{"Tells a lot.", "And more."}));
  EXPECT_EQ(footer.exit_statuses, (Codes{{"0", "done"}, {"1", "failed (the others are done); still"}, {"78", "bad"}}));
  EXPECT_EQ(footer.examples, (Strings{"a --b", "c | d"}));
}

TEST(HelpFooter, may_be_empty) {
  const HelpFooter footer = parse_footer("");
  EXPECT_TRUE(footer.paragraphs.empty() && footer.examples.empty() && footer.exit_statuses.empty());
}

}  // namespace
}  // namespace stairway::tools
