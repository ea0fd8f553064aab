// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "drivers/ports/can_port.hpp"
#include "tools/doctor/can_link.hpp"
#include "tools/doctor/check.hpp"

namespace stairway::doctor {

struct CanFacts {
  std::string interface;            ///< that the settings name
  std::string no_kernel_support;    ///< why CAN sockets cannot be had; empty when they can
  std::optional<LinkInfo> link;     ///< empty when there is no such interface
  std::vector<std::string> others;  ///< CAN interfaces of other names
};
CanFacts look_at_can(const std::string& interface);

/// can, can-link, can-bus.
std::vector<Check> judge(const CanFacts& facts);

/// What was heard on the bus.
struct DriveFacts {
  int node = 1;
  bool was_asked = false;                    ///< for its device type
  std::uint64_t frames = 0;                  ///< of anybody
  std::optional<std::uint8_t> heartbeat;     ///< the NMT state in the newest one; 0 is boot-up
  std::optional<std::uint32_t> device_type;  ///< object 1000
  std::optional<std::uint32_t> abort_code;   ///< instead of it
  std::set<int> other_nodes;                 ///< whose heartbeats came
  std::set<drivers::CanCondition> conditions;
};

/// Listens until the drive has said what is wanted, at most for `patience`. Only `may_ask` sends anything: one SDO
/// upload of object 1000.
/// @param now  on the time line of the port's stamps.
DriveFacts listen_for_drive(drivers::CanPort& port, int node, bool may_ask, std::chrono::nanoseconds patience,
                            const std::function<drivers::HostStamp()>& now);

/// drive.
Check judge(const DriveFacts& facts);

}  // namespace stairway::doctor
