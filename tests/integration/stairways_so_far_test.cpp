// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "tools/stairwayd/stairways_so_far.hpp"

#include <gtest/gtest.h>

namespace stairway::daemon {
namespace {

using Ids = std::vector<std::int64_t>;

detect::Stairway stairway_at(double x_m) {
  detect::Stairway stairway;
  stairway.nosings = {{{x_m, 0.5, 0.17}, {x_m, -0.5, 0.17}}, {{x_m + 0.3, 0.5, 0.34}, {x_m + 0.3, -0.5, 0.34}}};
  return stairway;
}

TEST(StairwaysSoFar, keeps_what_a_later_preview_does_not_show_as_it_was_seen) {
  StairwaysSoFar so_far;
  const auto preview = [&](std::int64_t sweep, std::int64_t utime_us, std::vector<double> places_m, Ids ids) {
    ipc::StairwaysMessage message{.utime_us = utime_us, .sweep = sweep, .is_final = false, .track_ids = std::move(ids)};
    for (const double place_m : places_m) message.detection.stairways.push_back(stairway_at(place_m));
    so_far.complete(message);
    return message;
  };
  EXPECT_EQ(preview(0, 10, {2}, {1}).seen_utimes_us, Ids{10});
  const auto other = preview(0, 20, {5}, {2});
  EXPECT_EQ(other.track_ids, (Ids{2, 1}));
  EXPECT_EQ(other.seen_utimes_us, (Ids{20, 10}));
  EXPECT_EQ(other.detection.stairways[1].met_nosing().middle().x(), 2.0);
  const auto again = preview(0, 30, {2.1}, {1});
  EXPECT_EQ(again.track_ids, (Ids{1, 2}));
  EXPECT_EQ(again.seen_utimes_us, (Ids{30, 20}));
  EXPECT_EQ(again.detection.stairways[0].met_nosing().middle().x(), 2.1);
  EXPECT_EQ(preview(1, 40, {5}, {2}).track_ids, Ids{2}) << "what an earlier sweep showed is not repeated";
  so_far.forget();
  EXPECT_EQ(preview(1, 50, {2}, {1}).track_ids, Ids{1});
}

}  // namespace
}  // namespace stairway::daemon
