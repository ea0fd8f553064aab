// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <string_view>

#include "drivers/types.hpp"

namespace stairway::drivers {

/// One message of the sensor, without the empty line that ends it.
struct ScipBlock {
  std::string_view text;          ///< echo line, status line, data lines, each ended by LF; valid during the call only
  HostStamp arrival_ns = 0;       ///< arrival of the chunk that held its first byte [ns]
  bool is_arrival_exact = false;  ///< its first byte was the first of that chunk, so the stamp is its own
};

/// Cuts the byte stream at empty lines, which never occur inside a message, however the bytes were cut on their way.
/// Holds at most `max_block_bytes` and the chunk at hand; a longer run without an empty line is dropped and counted,
/// and reading goes on behind the next empty line.
class ScipFramer {
 public:
  explicit ScipFramer(std::size_t max_block_bytes = 16384) : max_block_bytes_(max_block_bytes) {}

  /// Adds bytes that arrived together and hands every message they complete to `on_block`, oldest first.
  void add(std::string_view bytes, HostStamp arrival_ns, const std::function<void(const ScipBlock&)>& on_block);

  /// Forgets a half-read message.
  void clear();

  std::size_t overflows() const { return overflows_; }
  bool is_inside_block() const { return !pending_.empty(); }

 private:
  void add_piece(std::string_view piece, HostStamp arrival_ns, bool is_first_of_chunk);
  bool is_block_complete() const;

  std::size_t max_block_bytes_;
  std::string pending_;
  HostStamp arrival_ns_ = 0;
  bool is_arrival_exact_ = false;
  bool is_skipping_ = false;
  std::size_t overflows_ = 0;
};

}  // namespace stairway::drivers
