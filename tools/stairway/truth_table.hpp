// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "detector/stairway.hpp"

namespace stairway::tools {

/// The truth as lines for a person, below each one what was found there and the difference in mm and degrees.
std::string truth_text(const std::vector<detect::Stairway>& truth, const std::vector<detect::Stairway>& found);

}  // namespace stairway::tools
