// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tools/sim/disk_motion.hpp"

namespace stairway::sim {
namespace {

using drivers::HostStamp;

constexpr double kTwoPi = 2 * std::numbers::pi;
constexpr HostStamp kSecond_ns = 1'000'000'000;

TEST(SimDiskMotion, goes_on_from_where_the_speed_changed) {
  DiskMotion motion{0, 1.0, 0.5};
  motion.set_speed(2 * kSecond_ns, -1.0);
  motion.set_speed(3 * kSecond_ns, 0.0);
  EXPECT_NEAR(motion.angle_at(kSecond_ns), 1.5, 1e-12);
  EXPECT_NEAR(motion.angle_at(2 * kSecond_ns), 2.0, 1e-12);
  EXPECT_NEAR(motion.angle_at(2 * kSecond_ns + kSecond_ns / 2), 1.5, 1e-12);
  EXPECT_NEAR(motion.angle_at(9 * kSecond_ns), 1.0, 1e-12);
}

TEST(SimEncoder, samples_lie_on_the_true_motion_at_every_count) {
  for (const double speed : {kTwoPi / 35, -kTwoPi / 5, kTwoPi}) {
    SCOPED_TRACE(speed);
    const DiskMotion motion{0, 0.0, speed};
    FakeEncoder encoder{motion, 0, 4096};
    const auto samples = encoder.samples_until(motion, kSecond_ns);
    EXPECT_NEAR(static_cast<double>(samples.size()), 4096 * std::abs(speed) / kTwoPi, 1.5);
    HostStamp before = 0;
    for (const auto& sample : samples) {
      EXPECT_GT(sample.stamp_ns, before);
      EXPECT_NEAR(sample.angle_rad, motion.angle_at(sample.stamp_ns), 1e-7);
      EXPECT_NEAR(std::remainder(sample.angle_rad, kTwoPi / 4096), 0.0, 1e-9);
      EXPECT_TRUE(sample.valid);
      before = sample.stamp_ns;
    }
  }
}

TEST(SimEncoder, does_not_depend_on_how_often_it_is_read) {
  DiskMotion motion{0, 0.0, 1.0};
  motion.set_speed(100'000'000, -2.0);
  motion.set_speed(300'000'000, 0.0);
  FakeEncoder once{motion, 0, 1000};
  FakeEncoder often{motion, 0, 1000};
  const auto expected = once.samples_until(motion, kSecond_ns);
  std::vector<drivers::AngleSample> samples;
  for (HostStamp now = 0; now <= kSecond_ns; now += 1'234'567) {
    for (const auto& sample : often.samples_until(motion, now)) samples.push_back(sample);
  }
  for (const auto& sample : often.samples_until(motion, kSecond_ns)) samples.push_back(sample);
  ASSERT_EQ(samples.size(), expected.size());
  for (std::size_t i = 0; i < samples.size(); ++i) {
    EXPECT_EQ(samples[i].stamp_ns, expected[i].stamp_ns);
    EXPECT_EQ(samples[i].angle_rad, expected[i].angle_rad);
  }
}

TEST(SimEncoder, repeats_its_angle_at_rest) {
  const DiskMotion motion{0, 0.0, 0.0};
  FakeEncoder encoder{motion, 0, 4096};
  EXPECT_EQ(encoder.samples_until(motion, kSecond_ns).size(), 20U);
}

TEST(SimEncoder, is_valid_after_the_first_index) {
  const DiskMotion motion{0, kTwoPi - 0.5, 1.0};
  FakeEncoder encoder{motion, 0, 4096};
  for (const auto& sample : encoder.samples_until(motion, kSecond_ns)) {
    EXPECT_EQ(sample.valid, sample.angle_rad > kTwoPi - 1e-6);
  }
}

}  // namespace
}  // namespace stairway::sim
