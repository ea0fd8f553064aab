// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "drivers/scip/stamp_unwrapper.hpp"

namespace stairway::drivers {
namespace {

constexpr std::uint32_t kRange_ms = 1U << 24;

}  // namespace

StampUnwrapper::Result StampUnwrapper::unwrap(std::uint32_t raw_ms) {
  raw_ms &= kRange_ms - 1;
  const bool is_back = last_raw_ms_ && raw_ms < *last_raw_ms_;
  const bool is_wrap = is_back && *last_raw_ms_ - raw_ms > kRange_ms / 2;
  const bool is_reset = is_back && !is_wrap;
  if (is_wrap) offset_ms_ += kRange_ms;
  if (is_reset || !last_raw_ms_) offset_ms_ = 0;
  last_raw_ms_ = raw_ms;
  return {offset_ms_ + raw_ms, is_reset};
}

}  // namespace stairway::drivers
