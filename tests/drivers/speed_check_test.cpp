// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "drivers/disk/speed_check.hpp"

#include <gtest/gtest.h>

namespace stairway::drivers {
namespace {

const DiskUnits kUnits{.counts_per_turn = 200'000,
                       .velocity_units_per_turn_per_s = 100'000,
                       .is_drive_reversed = false,
                       .encoder_counts_per_turn = 4096,
                       .is_encoder_reversed = false,
                       .acceleration_rad_s2 = 1.0};

TEST(SpeedCheck, speeds_that_fit_are_silent) {
  for (const double speed : {0.1, -0.1}) {
    EXPECT_FALSE(compare_speeds({speed, speed, speed, speed}, {}, kUnits));
    EXPECT_FALSE(compare_speeds({speed, 1.1 * speed, 0.95 * speed, 1.15 * speed}, {}, kUnits));
    EXPECT_FALSE(compare_speeds({speed, speed, speed, std::nullopt, false}, {}, kUnits));
  }
  EXPECT_FALSE(compare_speeds({0.0, 0.001, -0.001, 0.0}, {}, kUnits));
}

TEST(SpeedCheck, names_the_trouble_and_what_to_look_at) {
  const struct {
    const char* what;
    DiskSpeeds speeds;
    DiskTrouble trouble;
    std::vector<const char*> words;
  } cases[] = {
      {"nothing turns", {0.1, 0.0, 0.0, 0.0}, DiskTrouble::NotTurning, {"brake"}},
      {"nothing is heard", {0.1, {}, {}, {}}, DiskTrouble::NotTurning, {"the drive tells nothing"}},
      {"encoder stands", {0.1, 0.1, 0.1, 0.0}, DiskTrouble::EncoderSilent, {"coupling"}},
      {"encoder says nothing", {0.1, 0.1, 0.1, {}}, DiskTrouble::EncoderSilent, {"the encoder nothing"}},
      {"drive stands", {0.1, 0.0, 0.0, 0.1}, DiskTrouble::DriveSilent, {"feedback"}},
      {"encoder backwards",
       {0.1, 0.1, 0.1, -0.1},
       DiskTrouble::Reversed,
       {"counter-clockwise, set encoder.reverse = true", "else motor.reverse = true"}},
      {"clockwise, encoder backwards", {-0.1, -0.1, -0.1, 0.1}, DiskTrouble::Reversed, {"turns clockwise"}},
      {"drive against its target", {0.1, -0.1, -0.1, -0.1}, DiskTrouble::Reversed, {"607E"}},
      {"drive says the wrong sign", {0.1, -0.1, -0.1, 0.1}, DiskTrouble::Reversed, {"607E", "feedback"}},
      {"encoder or both drive units",
       {0.1, 0.1, 0.1, 0.4},
       DiskTrouble::Mismatch,
       {"encoder turns 4 times as fast as the drive says", "motor.counts_per_turn (50000 would fit)",
        "motor.velocity_units_per_turn_per_s (25000 would fit)", "or encoder.counts_per_turn (16384 would fit)"}},
      {"velocity unit",
       {0.1, 0.1, 0.4, 0.4},
       DiskTrouble::Mismatch,
       {"check motor.velocity_units_per_turn_per_s (25000 would fit)"}},
      {"position unit",
       {0.1, 0.1, 0.05, 0.1},
       DiskTrouble::Mismatch,
       {"check motor.counts_per_turn (100000 would fit)"}},
      {"drive without encoder",
       {0.1, 0.1, 0.2, {}, false},
       DiskTrouble::Mismatch,
       {"position changes 2 times as fast", "motor.counts_per_turn (400000 would fit)",
        "motor.velocity_units_per_turn_per_s (50000 would fit)"}},
      {"too slow", {0.1, 0.05, 0.05, 0.05}, DiskTrouble::NotReached, {"load"}},
      {"pushed", {0.0, 0.0, 0.0, 0.05}, DiskTrouble::Unasked, {"pushed"}},
      {"driven by another", {0.0, 0.05, 0.05, 0.0}, DiskTrouble::Unasked, {"another program"}},
  };
  for (const auto& test : cases) {
    SCOPED_TRACE(test.what);
    const auto finding = compare_speeds(test.speeds, {}, kUnits);
    ASSERT_TRUE(finding);
    EXPECT_EQ(finding->trouble, test.trouble) << to_string(finding->trouble);
    for (const char* words : test.words) EXPECT_NE(finding->detail.find(words), std::string::npos) << finding->detail;
  }
}

TEST(SpeedCheck, units_that_were_checked_are_not_blamed_for_slip) {
  const auto finding = compare_speeds({0.1, 0.1, 0.1, 0.07}, {.tolerance = 0.1, .is_check = false}, kUnits);
  ASSERT_TRUE(finding);
  EXPECT_EQ(finding->trouble, DiskTrouble::Slip);
  EXPECT_EQ(finding->detail.find("would fit"), std::string::npos);
}

}  // namespace
}  // namespace stairway::drivers
