// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdint>
#include <tl/expected.hpp>
#include <vector>

#include "drivers/ports/byte_port.hpp"
#include "drivers/types.hpp"

namespace stairway::drivers {

enum class EncoderLine : std::uint8_t { A, B, Index };

/// A change of one line's level.
struct Edge {
  HostStamp stamp_ns = 0;  ///< taken by the kernel [ns]
  EncoderLine line = EncoderLine::A;
  bool is_rising = false;
};

struct EdgeBatch {
  std::vector<Edge> edges;       ///< by stamp; empty when the wait ended without any
  std::uint64_t lost_edges = 0;  ///< known to be missing before these; always 0 where the kernel does not tell
  HostStamp complete_ns = 0;     ///< later edges than these have later stamps than this, short of one interrupt [ns]
};

/// The lines were read at some instant between `asked_ns` and `stamp_ns`; an edge between the two may be in the levels
/// or not.
struct LineLevels {
  HostStamp asked_ns = 0;  ///< edges older than this are already in the levels [ns]
  HostStamp stamp_ns = 0;  ///< edges younger than this are not in the levels yet, >= asked_ns [ns]
  bool a = false;
  bool b = false;
  bool index = false;  ///< low where there is no index line
};

/// The place where the encoder's edges enter the process: GPIO lines or a simulated encoder. A port is used by one
/// thread. After `Closed` it stays closed; whoever opened it opens another one.
class EdgePort {
 public:
  virtual ~EdgePort() = default;
  /// Waits at most `timeout` for edges.
  virtual tl::expected<EdgeBatch, PortError> read(std::chrono::nanoseconds timeout) = 0;
  virtual tl::expected<LineLevels, PortError> levels() = 0;
  /// How many edges of each line are kept until they are read; more of them are lost.
  virtual int queued_edges() const = 0;
};

}  // namespace stairway::drivers
