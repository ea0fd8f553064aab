// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

namespace stairway::drivers {

/// Carries the sensor's 24-bit millisecond counter past its wrap (every 16777.216 s).
///
/// A step back of more than half the range is a wrap; any smaller one means that the counter was set to zero (RS,
/// power) or that stamps came out of order: counting then starts again from the stamp itself.
class StampUnwrapper {
 public:
  struct Result {
    std::int64_t stamp_ms = 0;  ///< milliseconds on one line since the last reset of the counter [ms]
    bool is_reset = false;      ///< the counter does not continue the one before
  };

  /// @param raw_ms  as sent; only the low 24 bits count.
  Result unwrap(std::uint32_t raw_ms);

  /// Forgets the past, so that the next stamp is neither a wrap nor a reset.
  void clear() { last_raw_ms_.reset(); }

 private:
  std::optional<std::uint32_t> last_raw_ms_;
  std::int64_t offset_ms_ = 0;
};

}  // namespace stairway::drivers
