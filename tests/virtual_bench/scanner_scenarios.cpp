// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <chrono>

#include "drivers/host_clock.hpp"
#include "drivers/usb/usb_scanner_opener.hpp"
#include "drivers/utm30lx.hpp"
#include "tests/virtual_bench/machine.hpp"

namespace stairway::bench {
namespace {

using namespace std::chrono_literals;

// The driver of the scanner alone, so that a failure of the daemon can be told from one of the USB.
class ScannerDriver : public testing::Test {
 protected:
  bool has_scans(std::uint64_t count, std::chrono::seconds timeout) {
    const auto end = std::chrono::steady_clock::now() + timeout;
    const std::uint64_t goal = scanner_.session().counters().scans + count;
    while (scanner_.session().counters().scans < goal) {
      if (std::chrono::steady_clock::now() > end) return false;
      for (const drivers::ScipEvent& event : scanner_.poll(100ms)) {
        if (const auto* trouble = std::get_if<drivers::ScipTroubleEvent>(&event)) troubles_ += trouble->detail + "; ";
        if (const auto* scan = std::get_if<drivers::LaserScan>(&event)) beams_ = scan->ranges_m.size();
      }
    }
    return true;
  }

  Rig& rig_ = Machine::get().rig();
  drivers::Utm30lx scanner_{drivers::usb_scanner_opener({}, {}), drivers::monotonic_now_ns, {}};
  std::size_t beams_ = 0;
  std::string troubles_;
};

TEST_F(ScannerDriver, streams_over_usb) {
  EXPECT_TRUE(has_scans(100, 30s)) << troubles_;
  EXPECT_EQ(beams_, 1081u);
}

TEST_F(ScannerDriver, streams_again_after_a_replug) {
  ASSERT_TRUE(has_scans(20, 30s)) << troubles_;
  rig_.unplug_scanner();
  EXPECT_FALSE(has_scans(30, 1s));
  rig_.plug_scanner();
  EXPECT_TRUE(has_scans(20, 30s)) << troubles_;
  EXPECT_GT(scanner_.session().counters().count(drivers::ScipTrouble::Disconnected), 0u);
}

}  // namespace
}  // namespace stairway::bench
