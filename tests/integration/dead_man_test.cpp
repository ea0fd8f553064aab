// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "tools/stairwayd/dead_man.hpp"

#include <gtest/gtest.h>

namespace stairway::daemon {
namespace {

TEST(DeadMan, is_missed_when_the_last_decision_is_old_until_the_next_one) {
  DeadMan dead_man(1000);
  EXPECT_FALSE(dead_man.is_missed(1000 + DeadMan::kPatience_ns));
  EXPECT_FALSE(dead_man.was_missed());
  EXPECT_TRUE(dead_man.is_missed(1001 + DeadMan::kPatience_ns));
  EXPECT_TRUE(dead_man.was_missed());
  dead_man.note(1001 + DeadMan::kPatience_ns);
  EXPECT_FALSE(dead_man.was_missed());
  EXPECT_FALSE(dead_man.is_missed(1001 + 2 * DeadMan::kPatience_ns));
}

}  // namespace
}  // namespace stairway::daemon
