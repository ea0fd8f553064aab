// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "scan_assembly/angle_track.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

namespace stairway::scan {
namespace {

constexpr drivers::HostStamp kMs = 1'000'000;

AngleTrack make_track(std::initializer_list<drivers::AngleSample> samples, const AngleTrackOptions& options = {}) {
  AngleTrack track(options);
  for (const auto& sample : samples) EXPECT_TRUE(track.add(sample));
  return track;
}

TEST(AngleTrack, draws_straight_lines_between_samples) {
  const AngleTrack track = make_track({{0, 1.0, true}, {10 * kMs, 2.0, true}, {30 * kMs, 0.0, true}});
  EXPECT_DOUBLE_EQ(track.at(0).value(), 1.0);
  EXPECT_DOUBLE_EQ(track.at(5 * kMs).value(), 1.5);
  EXPECT_DOUBLE_EQ(track.at(10 * kMs).value(), 2.0);
  EXPECT_DOUBLE_EQ(track.at(20 * kMs).value(), 1.0);
  EXPECT_DOUBLE_EQ(track.at(30 * kMs).value(), 0.0);
}

TEST(AngleTrack, goes_on_past_the_newest_sample_for_a_bounded_time) {
  const AngleTrack track = make_track({{0, 0.0, true}, {10 * kMs, 0.1, true}});
  EXPECT_NEAR(track.at(15 * kMs).value(), 0.15, 1e-12);
  EXPECT_NEAR(track.at(20 * kMs).value(), 0.2, 1e-12);
  EXPECT_EQ(track.at(20 * kMs + 1).error(), AngleError::Unknown);
}

TEST(AngleTrack, does_not_know_what_it_was_not_told) {
  EXPECT_EQ(AngleTrack().at(0).error(), AngleError::Unknown);
  EXPECT_FALSE(AngleTrack().newest_ns());
  const AngleTrack one = make_track({{10 * kMs, 1.0, true}});
  EXPECT_EQ(one.at(9 * kMs).error(), AngleError::Unknown);
  EXPECT_DOUBLE_EQ(one.at(10 * kMs).value(), 1.0);
  EXPECT_EQ(one.at(11 * kMs).error(), AngleError::Unknown);
  const AngleTrack gap = make_track({{0, 0.0, true}, {300 * kMs, 1.0, true}});
  EXPECT_EQ(gap.at(100 * kMs).error(), AngleError::Unknown);
}

TEST(AngleTrack, is_invalid_next_to_an_invalid_sample) {
  const AngleTrack track =
      make_track({{0, 0.0, true}, {10 * kMs, 0.1, false}, {20 * kMs, 0.2, true}, {30 * kMs, 0.3, true}});
  EXPECT_EQ(track.at(5 * kMs).error(), AngleError::Invalid);
  EXPECT_EQ(track.at(15 * kMs).error(), AngleError::Invalid);
  EXPECT_NEAR(track.at(25 * kMs).value(), 0.25, 1e-12);
}

TEST(AngleTrack, refuses_samples_out_of_order_and_counts_them) {
  AngleTrack track = make_track({{10 * kMs, 1.0, true}});
  EXPECT_FALSE(track.add({10 * kMs, 2.0, true}));
  EXPECT_FALSE(track.add({5 * kMs, 2.0, true}));
  EXPECT_FALSE(track.add({20 * kMs, std::numeric_limits<double>::quiet_NaN(), true}));
  EXPECT_EQ(track.refused_samples(), 3U);
  EXPECT_DOUBLE_EQ(track.at(10 * kMs).value(), 1.0);
}

TEST(AngleTrack, forgets_the_oldest_samples) {
  AngleTrackOptions options;
  options.max_samples = 100;
  AngleTrack track(options);
  for (int i = 0; i < 1000; ++i) track.add({i * kMs, 0.001 * i, true});
  EXPECT_EQ(track.size(), 100U);
  EXPECT_FALSE(track.at(899 * kMs));
  EXPECT_NEAR(track.at(900 * kMs).value(), 0.9, 1e-12);
}

TEST(AngleTrack, tells_the_speed_in_either_direction) {
  for (const double speed_rad_s : {0.18, -6.0, 0.0}) {
    SCOPED_TRACE(speed_rad_s);
    AngleTrack track;
    EXPECT_FALSE(track.speed_rad_s());
    for (int i = 0; i < 500; ++i) track.add({i * kMs, speed_rad_s * 1e-3 * i, true});
    ASSERT_TRUE(track.speed_rad_s());
    EXPECT_NEAR(*track.speed_rad_s(), speed_rad_s, 1e-9);
    track.add({600 * kMs, 0.0, false});
    EXPECT_FALSE(track.speed_rad_s());
  }
}

TEST(AngleTrackOptions, name_what_is_wrong) {
  EXPECT_EQ(AngleTrackOptions{}.problem(), "");
  AngleTrackOptions options;
  options.max_gap_s = 0.0;
  EXPECT_NE(options.problem().find("max_gap"), std::string::npos);
  options = {};
  options.max_samples = 1;
  EXPECT_NE(options.problem().find("max_samples"), std::string::npos);
}

}  // namespace
}  // namespace stairway::scan
