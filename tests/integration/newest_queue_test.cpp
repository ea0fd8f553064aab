// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "tools/stairwayd/newest_queue.hpp"

#include <gtest/gtest.h>

#include <thread>

namespace stairway::daemon {
namespace {

TEST(NewestQueue, drops_the_oldest_when_full) {
  NewestQueue<int> queue(2);
  EXPECT_TRUE(queue.push(1));
  EXPECT_TRUE(queue.push(2));
  EXPECT_FALSE(queue.push(3));
  EXPECT_EQ(queue.pop({}), 2);
  EXPECT_EQ(queue.pop({}), 3);
}

TEST(NewestQueue, waiting_taker_gets_what_comes_and_then_the_stop) {
  NewestQueue<int> queue(1);
  std::optional<int> first, second = 0;
  std::jthread taker([&](std::stop_token stop) {
    first = queue.pop(stop);
    second = queue.pop(stop);
  });
  queue.push(7);
  while (!queue.push(8)) {
  }
  taker.request_stop();
  taker.join();
  EXPECT_TRUE(first == 7 || first == 8);
  EXPECT_TRUE(second == std::nullopt || second == 8);
}

TEST(NewestQueue, stop_comes_before_waiting_values) {
  NewestQueue<int> queue(1);
  queue.push(1);
  std::stop_source source;
  source.request_stop();
  EXPECT_EQ(queue.pop(source.get_token()), std::nullopt);
}

TEST(NewestQueue, wait_with_a_limit_ends_with_or_without_a_value) {
  NewestQueue<int> queue(1);
  EXPECT_EQ(queue.pop_within(std::chrono::milliseconds(1)), std::nullopt);
  queue.push(3);
  EXPECT_EQ(queue.pop_within(std::chrono::milliseconds(0)), 3);
  EXPECT_EQ(queue.pop_within(std::chrono::milliseconds(0)), std::nullopt);
}

}  // namespace
}  // namespace stairway::daemon
