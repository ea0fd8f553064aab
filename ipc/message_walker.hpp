// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace stairway::ipc {

/// Steps over the fields of an encoded LCM message and notes whether each lies within it.
///
/// The code that lcm-gen 1.3.1 writes believes every count and text length it reads, so a damaged message could make it
/// read past the end or ask for gigabytes. A message is decoded only after a walk over its layout has succeeded.
class MessageWalker {
 public:
  explicit MessageWalker(std::span<const std::uint8_t> bytes) : left_(bytes) {}

  MessageWalker& skip(std::size_t bytes) {
    if (bytes > left_.size()) {
      fits_ = false;
      left_ = {};
    } else {
      left_ = left_.subspan(bytes);
    }
    return *this;
  }

  /// A count that is the length of a list; 0 once anything did not fit.
  std::size_t count() {
    const std::int64_t value = big_endian_int32();
    // An element takes a byte at least, which bounds the memory of whoever resizes a list to the count.
    if (value < 0 || static_cast<std::uint64_t>(value) > left_.size()) fits_ = false;
    return fits_ ? static_cast<std::size_t>(value) : 0;
  }

  /// A text: its length with the closing NUL, then the bytes.
  MessageWalker& text() {
    const std::int64_t length = big_endian_int32();
    if (length < 1) fits_ = false;
    return skip(fits_ ? static_cast<std::size_t>(length) : 0);
  }

  MessageWalker& texts(std::size_t number) {
    for (std::size_t i = 0; i < number && fits_; ++i) text();
    return *this;
  }

  /// Whether everything was there and nothing is left over.
  bool ends_here() const { return fits_ && left_.empty(); }
  bool fits() const { return fits_; }

 private:
  std::int64_t big_endian_int32() {
    if (left_.size() < 4) {
      fits_ = false;
      return 0;
    }
    const std::uint32_t value = std::uint32_t{left_[0]} << 24 | std::uint32_t{left_[1]} << 16 |
                                std::uint32_t{left_[2]} << 8 | std::uint32_t{left_[3]};
    left_ = left_.subspan(4);
    return static_cast<std::int32_t>(value);
  }

  std::span<const std::uint8_t> left_;
  bool fits_ = true;
};

}  // namespace stairway::ipc
