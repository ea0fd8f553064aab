// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace stairway::sim {

/// What a UTM-30LX says about itself: the lines of its answers to VV, PP and II, with sums.
std::string version_lines(std::string_view firmware, std::string_view serial);
std::string parameter_lines();
std::string state_lines(bool is_laser_on, std::uint32_t counter_ms, std::string_view status);

}  // namespace stairway::sim
