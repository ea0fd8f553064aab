// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "drivers/scip/sync_pulses.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace stairway::drivers {
namespace {

constexpr HostStamp kMs = 1'000'000;
constexpr HostStamp kTurn_ns = 25 * kMs;

// Gives one pulse for each turn at `phase_ns` and looks for it as the scan of the turn does.
struct Turns {
  explicit Turns(double offset_ns, HostStamp phase_ns = 7 * kMs) : pulses(offset_ns), phase(phase_ns) {}

  std::optional<HostStamp> turn(HostStamp arrival_error_ns = 0, bool has_pulse = true) {
    rear_ns += kTurn_ns;
    if (has_pulse) pulses.add(rear_ns + phase);
    return pulses.match(rear_ns + arrival_error_ns);
  }

  SyncPulses pulses;
  HostStamp phase;
  HostStamp rear_ns = 1'000 * kMs;
};

TEST(SyncPulses, are_believed_after_a_second_and_tell_the_turn) {
  Turns turns(7e6);
  for (int i = 0; i < 40; ++i) {
    EXPECT_FALSE(turns.pulses.is_locked());
    turns.turn();
  }
  EXPECT_FALSE(turns.pulses.is_locked());  // the first pulse has none before it
  turns.turn();
  EXPECT_TRUE(turns.pulses.is_locked());
  EXPECT_EQ(turns.turn(2 * kMs), turns.rear_ns);
  EXPECT_EQ(turns.turn(-9 * kMs), turns.rear_ns);
  EXPECT_EQ(turns.pulses.pulses(), 43U);
}

TEST(SyncPulses, are_left_out_where_the_setting_does_not_expect_them) {
  Turns turns(0.0);
  for (int i = 0; i < 100; ++i) turns.turn();
  EXPECT_FALSE(turns.pulses.is_locked());
  EXPECT_TRUE(turns.pulses.is_misplaced());
  EXPECT_NEAR(turns.pulses.residual_ns(), 7e6, 1.0);
}

TEST(SyncPulses, are_no_longer_believed_a_second_after_the_last_one) {
  Turns turns(7e6);
  for (int i = 0; i < 50; ++i) turns.turn();
  for (int i = 0; i < 39; ++i) EXPECT_FALSE(turns.turn(0, false));
  EXPECT_TRUE(turns.pulses.is_locked());
  turns.turn(0, false);
  EXPECT_FALSE(turns.pulses.is_locked());
  for (int i = 0; i < 45; ++i) turns.turn();
  EXPECT_TRUE(turns.pulses.is_locked());
}

TEST(SyncPulses, that_come_unevenly_are_noise) {
  Turns turns(7e6);
  for (int i = 0; i < 200; ++i) {
    turns.pulses.add(turns.rear_ns + kTurn_ns + 2 * kMs);
    turns.turn();
  }
  EXPECT_FALSE(turns.pulses.is_locked());
  EXPECT_FALSE(turns.pulses.is_misplaced());
}

TEST(SyncPulses, that_go_back_in_time_are_left_out) {
  SyncPulses pulses(0.0);
  pulses.add(100);
  pulses.add(100);
  pulses.add(50);
  EXPECT_EQ(pulses.pulses(), 1U);
  EXPECT_FALSE(pulses.match(100));
}

}  // namespace
}  // namespace stairway::drivers
