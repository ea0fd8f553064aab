// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "detector/stairway.hpp"

#include <cmath>

namespace stairway::detect {

double Stairway::pitch() const { return std::atan2(step_height, step_depth); }

}  // namespace stairway::detect
