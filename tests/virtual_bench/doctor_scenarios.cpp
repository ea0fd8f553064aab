// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cstdio>
#include <nlohmann/json.hpp>
#include <string>

#include "tests/virtual_bench/machine.hpp"

namespace stairway::bench {
namespace {

// With --probe, so that the drive, which no daemon has woken, is asked.
class Doctor : public testing::Test {
 protected:
  // The state of a check: ok, warning, failure or skipped; "none" where it was not made.
  std::string state_of(const std::string& check) {
    for (const auto& entry : checks_) {
      if (entry.at("name") == check) return entry.at("state");
    }
    return "none";
  }
  // Exit code.
  int examine() {
    const char* command =
        "timeout 60 " STAIRWAY " doctor --probe --format json --config " BENCH_SETTINGS " 2>/dev/null";
    std::FILE* pipe = ::popen(command, "r");
    if (pipe == nullptr) return -1;
    std::string text;
    for (int c = std::fgetc(pipe); c != EOF; c = std::fgetc(pipe)) text.push_back(static_cast<char>(c));
    const int status = ::pclose(pipe);
    const auto report = nlohmann::json::parse(text, nullptr, false);
    checks_ = report.is_discarded() ? nlohmann::json::array() : report.value("checks", nlohmann::json::array());
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }
  std::string told() const { return checks_.dump(1); }

  Rig& rig_ = Machine::get().rig();
  nlohmann::json checks_;
};

TEST_F(Doctor, finds_the_devices_of_a_healthy_robot_in_order) {
  examine();
  for (const char* check : {"settings", "lcm-route", "scanner", "scanner-answer", "scanner-access", "can", "can-link",
                            "drive", "encoder", "encoder-access", "encoder-lines"})
    EXPECT_EQ(state_of(check), "ok") << check << told();
}

TEST_F(Doctor, misses_the_scanner) {
  rig_.unplug_scanner();
  EXPECT_EQ(examine(), 2);
  rig_.plug_scanner();
  EXPECT_EQ(state_of("scanner"), "failure") << told();
  EXPECT_EQ(state_of("drive"), "ok") << told();
}

TEST_F(Doctor, sees_that_the_bus_is_down) {
  rig_.lower_bus();
  EXPECT_EQ(examine(), 2);
  rig_.raise_bus();
  EXPECT_EQ(state_of("can-link"), "failure") << told();
  EXPECT_EQ(state_of("scanner"), "ok") << told();
}

TEST_F(Doctor, does_not_hear_a_silent_drive) {
  Machine::get().order("drive silent");
  EXPECT_NE(examine(), 0);
  Machine::get().order("drive mend");
  EXPECT_NE(state_of("drive"), "ok") << told();
}

TEST_F(Doctor, misses_the_encoder) {
  rig_.remove_encoder_chip();
  EXPECT_EQ(examine(), 2);
  rig_.add_encoder_chip();
  EXPECT_EQ(state_of("encoder"), "failure") << told();
}

}  // namespace
}  // namespace stairway::bench
