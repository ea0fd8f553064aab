// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tools/sim/disk_motion.hpp"

namespace stairway::sim {
namespace {

using drivers::HostStamp;

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

}  // namespace
}  // namespace stairway::sim
