// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "drivers/scip/stamp_unwrapper.hpp"

#include <gtest/gtest.h>

namespace stairway::drivers {
namespace {

TEST(StampUnwrapper, goes_on_over_the_wrap_again_and_again) {
  StampUnwrapper unwrapper;
  const std::int64_t begin_ms = (1 << 24) - 1000;
  for (std::int64_t ms = begin_ms; ms < begin_ms + 3 * (1 << 24); ms += 24983) {
    const auto result = unwrapper.unwrap(static_cast<std::uint32_t>(ms) & 0xFFFFFF);
    ASSERT_EQ(result.stamp_ms, ms);
    ASSERT_FALSE(result.is_reset);
  }
}

TEST(StampUnwrapper, begins_anew_when_the_counter_was_set_back) {
  StampUnwrapper unwrapper;
  unwrapper.unwrap(0xFFFFF0);
  EXPECT_EQ(unwrapper.unwrap(0x10).stamp_ms, (1 << 24) + 0x10);
  unwrapper.unwrap(0x2000);
  const auto result = unwrapper.unwrap(5);
  EXPECT_TRUE(result.is_reset);
  EXPECT_EQ(result.stamp_ms, 5);
  EXPECT_FALSE(unwrapper.unwrap(30).is_reset);
}

TEST(StampUnwrapper, takes_an_equal_stamp_as_it_is) {
  StampUnwrapper unwrapper;
  unwrapper.unwrap(1000);
  EXPECT_FALSE(unwrapper.unwrap(1000).is_reset);
  EXPECT_EQ(unwrapper.unwrap(1000).stamp_ms, 1000);
}

TEST(StampUnwrapper, forgets_on_request) {
  StampUnwrapper unwrapper;
  unwrapper.unwrap(0xFFFFF0);
  unwrapper.clear();
  const auto result = unwrapper.unwrap(100);
  EXPECT_EQ(result.stamp_ms, 100);
  EXPECT_FALSE(result.is_reset);
}

}  // namespace
}  // namespace stairway::drivers
