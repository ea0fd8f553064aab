// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <mutex>

#include "drivers/types.hpp"
#include "tests/virtual_bench/scan_table.hpp"
#include "tools/sim/disk_motion.hpp"
#include "tools/sim/fake_drive.hpp"
#include "tools/sim/fake_utm30lx.hpp"

namespace stairway::bench {

/// Of A and B together, all edges.
inline constexpr std::int64_t kEncoderCountsPerTurn = 1024;

/// The machine's monotonic clock, the line of all stamps [ns].
drivers::HostStamp now_ns();

/// The robot that the kernel's drivers show to the daemon: one disk, the drive that turns it, the scanner on it and the
/// encoder that watches it, on one clock. Whoever touches what is not atomic holds the lock.
struct Robot {
  explicit Robot(ScanTable what_is_seen);

  std::mutex mutex;
  const ScanTable table;
  sim::DiskMotion motion;
  sim::FakeDrive drive;  ///< moves the disk as far as it was advanced
  sim::FakeUtm30lx scanner;
  std::atomic<bool> is_encoder_dead = false;  ///< its lines keep their levels
};

}  // namespace stairway::bench
