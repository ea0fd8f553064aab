// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "detector/parallel_ranges.hpp"

#include <gtest/gtest.h>

#include <numeric>
#include <stdexcept>
#include <vector>

namespace stairway::detect {
namespace {

TEST(ParallelRanges, cover_every_element_once_for_any_count_and_number_of_threads) {
  for (const std::size_t count : {0U, 1U, 2U, 7U, 100U, 101U}) {
    for (const int threads : {1, 2, 3, 64}) {
      SCOPED_TRACE(::testing::Message() << count << " elements, " << threads << " threads");
      std::vector<int> visits(count, 0);
      for_ranges(count, threads, 1, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i) ++visits[i];
      });
      EXPECT_EQ(visits, std::vector<int>(count, 1));
    }
  }
}

TEST(ParallelRanges, stay_with_the_caller_when_there_is_too_little_work) {
  const std::thread::id caller = std::this_thread::get_id();
  int calls = 0;
  for_ranges(19, 8, 10, [&](std::size_t first, std::size_t last) {
    ++calls;
    EXPECT_EQ(first, 0U);
    EXPECT_EQ(last, 19U);
    EXPECT_EQ(std::this_thread::get_id(), caller);
  });
  EXPECT_EQ(calls, 1);
}

TEST(ParallelRanges, throw_what_any_part_of_the_work_throws) {
  for (const std::size_t bad : {0U, 99U}) {
    EXPECT_THROW(for_ranges(100, 4, 1,
                            [&](std::size_t first, std::size_t last) {
                              if (bad >= first && bad < last) throw std::runtime_error("bad element");
                            }),
                 std::runtime_error);
  }
}

}  // namespace
}  // namespace stairway::detect
