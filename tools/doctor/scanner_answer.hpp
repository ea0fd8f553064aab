// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "drivers/utm30lx.hpp"
#include "tools/doctor/check.hpp"

namespace stairway::doctor {

/// What a scanner said when it was opened and let run for a moment.
struct ScannerAnswer {
  std::optional<drivers::ScipDeviceInfo> device;  ///< empty when VV, PP and II were not all answered
  std::uint64_t scans = 0;
  double scan_duration_s = 0.0;       ///< from the first to the last of them
  std::vector<std::string> troubles;  ///< told meanwhile, at most ten
};

/// Opens the scanner as the daemon does, its laser included, until 40 scans came or `patience` is over, and stops it.
ScannerAnswer ask_scanner(drivers::PortOpener<drivers::BytePort> opener, drivers::Utm30lx::Clock now,
                          const drivers::ScipOptions& options, std::chrono::nanoseconds patience);

/// scanner-answer, scanner-firmware, scanner-stream.
std::vector<Check> judge(const ScannerAnswer& answer, const std::string& wanted_serial);

}  // namespace stairway::doctor
