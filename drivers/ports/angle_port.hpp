// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <tl/expected.hpp>
#include <vector>

#include "drivers/ports/byte_port.hpp"
#include "drivers/types.hpp"

namespace stairway::drivers {

/// The place where the disk's angle enters the process: a GPIO encoder, the simulation, or a recording.
///
/// Samples come in the order of their stamps. A sample is stamped at the edge that made it, so that straight lines
/// between samples are the disk's motion and not the encoder's staircase; when no edge came for 50 ms the last angle is
/// repeated with a fresh stamp, so that a disk at rest can be told from a dead encoder.
/// A port is used by one thread. After `Closed` it stays closed; whoever opened it opens another one.
class AnglePort {
 public:
  virtual ~AnglePort() = default;
  /// Waits at most `timeout` for samples; empty when none came.
  virtual tl::expected<std::vector<AngleSample>, PortError> read(std::chrono::nanoseconds timeout) = 0;
};

}  // namespace stairway::drivers
