// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstddef>
#include <string>
#include <string_view>
#include <tl/expected.hpp>

#include "drivers/types.hpp"

namespace stairway::drivers {

/// Why a port could not read or write.
enum class PortError { Closed, Io };

/// Bytes that arrived together.
struct ByteChunk {
  HostStamp arrival_ns = 0;    ///< when the first of them arrived [ns]
  std::string bytes;           ///< empty when the wait ended without any; `arrival_ns` is then the time of the end
  std::size_t lost_bytes = 0;  ///< dropped before these, because nobody read in time
};

/// The place where the scanner's bytes enter and leave the process: USB, a simulated sensor, or a recording.
/// A port is used by one thread. After `Closed` it stays closed; whoever opened it opens another one.
class BytePort {
 public:
  virtual ~BytePort() = default;
  /// Waits at most `timeout` for bytes.
  virtual tl::expected<ByteChunk, PortError> read(std::chrono::nanoseconds timeout) = 0;
  /// Sends all of `bytes` or fails.
  virtual tl::expected<void, PortError> write(std::string_view bytes) = 0;
};

}  // namespace stairway::drivers
