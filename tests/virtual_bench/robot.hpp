// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <mutex>

#include "drivers/types.hpp"
#include "tests/virtual_bench/scan_table.hpp"
#include "tools/sim/disk_motion.hpp"
#include "tools/sim/fake_utm30lx.hpp"

namespace stairway::bench {

/// The machine's monotonic clock, the line of all stamps [ns].
drivers::HostStamp now_ns();

/// The robot that the kernel's drivers show to the daemon. Whoever touches a member holds the lock.
struct Robot {
  explicit Robot(ScanTable what_is_seen);

  std::mutex mutex;
  const ScanTable table;
  sim::DiskMotion motion;
  sim::FakeUtm30lx scanner;
};

}  // namespace stairway::bench
