// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "drivers/scip/unit_checks.hpp"

#include <gtest/gtest.h>

namespace stairway::drivers {
namespace {

TEST(UnitChecks, know_a_serial_however_it_is_written) {
  for (const char* other : {"00903971", "0903971", "903971", "H0903971", "h0903971", "H00903971"}) {
    EXPECT_TRUE(is_same_serial("00903971", other)) << other;
  }
  for (const char* other : {"", "H", "00903972", "9039710", "X0903971", "H090397"}) {
    EXPECT_FALSE(is_same_serial("00903971", other)) << other;
  }
  EXPECT_TRUE(is_same_serial("H0902680", "0902680"));
}

TEST(UnitChecks, warn_of_firmware_with_known_faults) {
  const struct {
    const char* firmware;
    const char* warning;  // a word of it; empty for none
  } cases[] = {
      {"P.1.05(17/Apr./2009)", "older"},
      {"1.16.01(16/Nov./2009)", "older"},
      {"1.16.02(19/Jan./2010)", "clock"},
      {"1.18.00", "older"},
      {"1.18.01(09/Jul./2010)", ""},
      {"1.20.02(02/Dec./2011)", ""},
      {"2.0.0", ""},
      {"", ""},
      {"unknown", ""},
      {"99999999999999999999.1", ""},
      {"P.", ""},
      {"1.16.2", "clock"},
  };
  for (const auto& [firmware, warning] : cases) {
    const std::string found = firmware_warning(firmware);
    EXPECT_EQ(found.empty(), std::string(warning).empty()) << firmware;
    EXPECT_NE(found.find(warning), std::string::npos) << firmware;
  }
}

}  // namespace
}  // namespace stairway::drivers
