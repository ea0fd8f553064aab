// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "drivers/canopen/motor_options.hpp"
#include "drivers/canopen/pdo_map.hpp"

namespace stairway::drivers {

/// One object that is read or written before the drive is started.
struct SetupStep {
  ObjectAddress object;
  std::optional<ObjectValue> value;  ///< to write; empty reads
  /// What a drive without this object cannot do; null when the disk cannot be driven without it.
  const char* without = nullptr;
};

/// The process data of the disk: RPDO 1 on its own, TPDO 1 and 2 at every SYNC.
std::vector<PdoMap> motor_pdo_maps(std::uint8_t node);

/// Everything between pre-operational and the start of the node, in order: identify, heartbeats, what to do when
/// this host falls silent, profile velocity mode with target 0, ramps, process data.
std::vector<SetupStep> motor_setup(const MotorOptions& options);

}  // namespace stairway::drivers
