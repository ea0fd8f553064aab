// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "tools/stairwayd/stairway_tracker.hpp"

#include <gtest/gtest.h>

namespace stairway::daemon {
namespace {

using Ids = std::vector<std::int64_t>;

detect::Stairway stairway_at(double x_m, double y_m) {
  detect::Stairway stairway;
  stairway.nosings = {{{x_m, y_m + 0.5, 0.17}, {x_m, y_m - 0.5, 0.17}}, {{x_m + 1, y_m, 0.34}, {x_m + 1, y_m, 0.34}}};
  return stairway;
}

TEST(StairwayTracker, keeps_numbers_when_the_order_changes) {
  StairwayTracker tracker;
  EXPECT_EQ(tracker.follow(std::vector{stairway_at(2, 0), stairway_at(0, 3)}), (Ids{1, 2}));
  EXPECT_EQ(tracker.follow(std::vector{stairway_at(0.1, 3), stairway_at(2, 0.1)}), (Ids{2, 1}));
}

TEST(StairwayTracker, new_place_direction_or_kind_is_a_new_stairway) {
  StairwayTracker tracker;
  EXPECT_EQ(tracker.follow(std::vector{stairway_at(2, 0)}), Ids{1});
  EXPECT_EQ(tracker.follow(std::vector{stairway_at(2.5, 0)}), Ids{2});
  detect::Stairway spiral = stairway_at(2, 0);
  spiral.kind = detect::StairwayKind::Spiral;
  EXPECT_EQ(tracker.follow(std::vector{spiral}), Ids{3});
}

TEST(StairwayTracker, forgets_after_three_missed_passes) {
  StairwayTracker tracker;
  tracker.follow(std::vector{stairway_at(2, 0)});
  for (int i = 0; i < 3; ++i) tracker.follow({});
  EXPECT_EQ(tracker.follow(std::vector{stairway_at(2, 0)}), Ids{1});
  for (int i = 0; i < 4; ++i) tracker.follow({});
  EXPECT_EQ(tracker.follow(std::vector{stairway_at(2, 0)}), Ids{2});
}

TEST(StairwayTracker, previews_and_answers_share_their_numbers) {
  StairwayTracker tracker;
  EXPECT_EQ(tracker.follow_preview(std::vector{stairway_at(2, 0)}), Ids{1});
  EXPECT_EQ(tracker.follow_preview(std::vector{stairway_at(0, 3), stairway_at(2, 0.1)}), (Ids{2, 1}));
  EXPECT_EQ(tracker.follow(std::vector{stairway_at(2, 0), stairway_at(0, 3)}), (Ids{1, 2}));
  EXPECT_EQ(tracker.follow_preview(std::vector{stairway_at(0, 3)}), Ids{2});
}

TEST(StairwayTracker, previews_that_do_not_show_it_make_nothing_forgotten) {
  StairwayTracker tracker;
  tracker.follow(std::vector{stairway_at(2, 0)});
  for (int i = 0; i < 20; ++i) tracker.follow_preview({});
  EXPECT_EQ(tracker.follow(std::vector{stairway_at(2, 0)}), Ids{1});
}

TEST(StairwayTracker, what_only_previews_showed_is_forgotten_after_three_answers_without_it) {
  StairwayTracker tracker;
  tracker.follow_preview(std::vector{stairway_at(2, 0)});
  for (int i = 0; i < 3; ++i) tracker.follow({});
  EXPECT_EQ(tracker.follow_preview(std::vector{stairway_at(2, 0)}), Ids{1});
  for (int i = 0; i < 4; ++i) tracker.follow({});
  EXPECT_EQ(tracker.follow(std::vector{stairway_at(2, 0)}), Ids{2});
}

TEST(StairwayTracker, part_of_a_stairway_in_a_preview_is_that_stairway) {
  StairwayTracker tracker;
  detect::Stairway part = stairway_at(2, 0);
  part.nosings.front() = {{2, 0.5, 0.17}, {2, 0.3, 0.17}};
  EXPECT_EQ(tracker.follow_preview(std::vector{part}), Ids{1});
  EXPECT_EQ(tracker.follow_preview(std::vector{stairway_at(2, 0)}), Ids{1});
  EXPECT_EQ(tracker.follow_preview(std::vector{part}), Ids{1});
  EXPECT_EQ(tracker.follow(std::vector{stairway_at(2, 0)}), Ids{1});
  EXPECT_EQ(tracker.follow(std::vector{part}), Ids{2}) << "whole sweeps are compared by the middles alone";
}

TEST(StairwayTracker, previews_of_another_place_do_not_move_the_last_answer) {
  StairwayTracker tracker;
  tracker.follow(std::vector{stairway_at(2, 0)});
  tracker.follow_preview(std::vector{stairway_at(2.25, 0)});
  EXPECT_EQ(tracker.follow(std::vector{stairway_at(1.8, 0)}), Ids{1});
}

TEST(StairwayTracker, two_near_ones_do_not_share_a_number) {
  StairwayTracker tracker;
  tracker.follow(std::vector{stairway_at(2, 0)});
  EXPECT_EQ(tracker.follow(std::vector{stairway_at(2.2, 0), stairway_at(2.05, 0)}), (Ids{2, 1}));
}

}  // namespace
}  // namespace stairway::daemon
