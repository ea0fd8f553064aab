// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <deque>
#include <mutex>
#include <optional>
#include <tl/expected.hpp>

#include "drivers/ports/byte_port.hpp"

namespace stairway::drivers {

/// Hands chunks from the thread that receives them to the one that reads them. Thread-safe.
class ChunkQueue {
 public:
  /// @param max_chunks  of more, the oldest is dropped, and its bytes are told with the next one that is read.
  explicit ChunkQueue(std::size_t max_chunks) : max_chunks_(max_chunks) {}

  /// A chunk without bytes ends a wait.
  void push(ByteChunk chunk);
  /// No more will come; what is there can still be read.
  void close();
  /// The oldest chunk, waiting for it at most `timeout`; empty when the wait ended without one. Closed when there is
  /// none and none will come.
  tl::expected<std::optional<ByteChunk>, PortError> pop(std::chrono::nanoseconds timeout);

 private:
  const std::size_t max_chunks_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<ByteChunk> chunks_;
  std::size_t lost_bytes_ = 0;
  bool is_closed_ = false;
};

}  // namespace stairway::drivers
