// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include "detector/stairway.hpp"

namespace stairway::tools {

/// Pairs of indices (truth, found) that mean the same stairway: the nosings of `found` lie on average within half a
/// metre of nosings of the truth. The nearest pair comes first, and nothing is paired twice.
std::vector<std::pair<std::size_t, std::size_t>> match(const std::vector<detect::Stairway>& truth,
                                                       const std::vector<detect::Stairway>& found);

}  // namespace stairway::tools
