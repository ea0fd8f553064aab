// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "drivers/scip/scip_status.hpp"

#include <gtest/gtest.h>

#include <string>

#include "drivers/scip/scip_replies.hpp"

namespace stairway::drivers {
namespace {

// The sum characters that the specification prints behind the statuses.
TEST(ScipStatus, every_status_is_written_and_read_with_its_sum) {
  for (const char* line : {"00P", "99b", "01Q", "02R", "03S", "04T", "05U", "06V", "07W", "10Q", "0Aa", "0Bb",
                           "0Cc", "0Dd", "0Ee", "0Ff", "0Gg", "0Hh", "0Ii", "0Ll", "21S", "50U", "98a"}) {
    const std::string status(line, 2);
    const std::string message = encode_reply("MD0000108001000", status);
    EXPECT_EQ(message, std::string("MD0000108001000\n") + line + "\n\n");
    const auto reply = parse_reply(std::string_view(message).substr(0, message.size() - 1));
    ASSERT_TRUE(reply) << line;
    EXPECT_EQ(reply->status, status);
  }
}

TEST(ScipStatus, means_what_the_specification_says_for_each_command) {
  const struct {
    const char* symbol;
    const char* status;
    StatusKind kind;
    const char* description;
  } cases[] = {
      {"MD0000108001000", "00", StatusKind::Ok, "00 (good)"},
      {"MD0000108001000", "99", StatusKind::Ok, "99 (good, with a scan)"},
      {"MD", "04", StatusKind::Refused, "04 (last step out of range)"},
      {"ME", "20", StatusKind::Refused, "20"},
      {"MD", "21", StatusKind::SelfCheck, "21 (the sensor checks itself)"},
      {"ME", "49", StatusKind::SelfCheck, "49 (the sensor checks itself)"},
      {"MS", "50", StatusKind::Fault, "50 (the laser or the motor is out of order)"},
      {"MD", "97", StatusKind::Fault, "97 (the laser or the motor is out of order)"},
      {"MD", "98", StatusKind::Resumed, "98 (the sensor has checked itself)"},
      {"MD", "0E", StatusKind::Unknown, "0E (unknown command)"},
      {"MD", "0L", StatusKind::Refused, "0L (abnormal state)"},
      {"GD", "10", StatusKind::Refused, "10 (the laser is off)"},
      {"GD", "50", StatusKind::Refused, "50 (the laser or the motor is out of order)"},
      {"BM", "01", StatusKind::Fault, "01 (the laser does not work)"},
      {"BM", "02", StatusKind::Refused, "02 (the laser is on already)"},
      {"BM", "10", StatusKind::Refused, "10 (not in this state)"},
      {"TM1", "04", StatusKind::Refused, "04 (asked for the time outside of time adjustment)"},
      {"CR00", "04", StatusKind::Refused, "04 (this sensor cannot change its motor's speed)"},
      {"QT", "0D", StatusKind::Unknown, "0D (not defined, or too long)"},
      {"VV", "55", StatusKind::Refused, "55"},
      {"", "ZZ", StatusKind::Refused, "ZZ"},
      {"M", "", StatusKind::Refused, ""},
      {"MD", "a long and senseless status", StatusKind::Refused, "a "},
  };
  for (const auto& [symbol, status, kind, description] : cases) {
    EXPECT_EQ(status_kind(symbol, status), kind) << symbol << ' ' << status;
    EXPECT_EQ(describe_status(symbol, status), description);
  }
}

}  // namespace
}  // namespace stairway::drivers
