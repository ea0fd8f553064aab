// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "tools/stairwayd/progress_watch.hpp"

#include <gtest/gtest.h>

namespace stairway::daemon {
namespace {

using namespace std::chrono_literals;

const ProgressWatch::Clock::time_point kStart{1000h};

TEST(ProgressWatch, wants_a_read_since_the_last_question) {
  ProgressWatch watch;
  EXPECT_FALSE(watch.has_progressed(kStart));
  watch.note_read();
  EXPECT_TRUE(watch.has_progressed(kStart + 1s));
  EXPECT_FALSE(watch.has_progressed(kStart + 2s));
}

TEST(ProgressWatch, gives_a_pass_a_minute) {
  ProgressWatch watch;
  watch.begin_pass(kStart);
  watch.note_read();
  EXPECT_TRUE(watch.has_progressed(kStart + 59s));
  watch.note_read();
  EXPECT_FALSE(watch.has_progressed(kStart + 60s));
  watch.end_pass();
  watch.note_read();
  EXPECT_TRUE(watch.has_progressed(kStart + 61s));
}

TEST(ProgressWatch, lets_acquisition_wait_for_a_detector_that_comes_back) {
  ProgressWatch watch;
  watch.note_waiting(true);
  watch.begin_pass(kStart);
  EXPECT_TRUE(watch.has_progressed(kStart + 59s));
  EXPECT_FALSE(watch.has_progressed(kStart + 60s));
  watch.note_waiting(false);
  watch.end_pass();
  EXPECT_FALSE(watch.has_progressed(kStart + 61s));
}

}  // namespace
}  // namespace stairway::daemon
