// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tools/doctor/check.hpp"
#include "tools/doctor/machine.hpp"

namespace stairway::doctor {

/// One Hokuyo scanner as the kernel's USB tree shows it.
struct UsbScanner {
  std::string port;                   ///< bus and ports, e.g. "1-1.2": stays the same until it is plugged in elsewhere
  std::string product;                ///< empty when the descriptor cannot be read
  NodeFacts node;                     ///< /dev/bus/usb/BUS/DEVICE
  std::vector<std::string> drivers;   ///< of its interfaces, "" where none is bound
  std::vector<std::string> ttys;      ///< that the kernel made of it, e.g. "ttyACM0"
  std::vector<ProcessFacts> holders;  ///< programs that have its node or its tty open
};

struct ScannerFacts {
  bool has_usb = false;  ///< the kernel has a USB tree at all
  std::vector<UsbScanner> scanners;
};
ScannerFacts look_for_scanners(const Machine& machine);

/// Which scanner the settings ask for.
struct WantedScanner {
  std::string serial;  ///< empty for any
  std::string port;    ///< likewise
};

/// scanner, scanner-access, scanner-interfaces.
/// @param has_daemon  a stairwayd runs, so that a claimed scanner is as it should be.
std::vector<Check> judge(const ScannerFacts& facts, const WantedScanner& wanted, const Caller& caller, bool has_daemon);

}  // namespace stairway::doctor
