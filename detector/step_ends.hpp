// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "detector/step_measurement.hpp"

namespace stairway::detect {

/// The end of a flight from those of its steps.
///
/// Posts and bystanders cut steps short, hardly anything makes them longer: of the places that many ends agree on, the
/// outermost is the flight's; ends that do not agree with it are left out.
/// @param outward  +1 where larger places lie farther out, -1 at the other side.
/// @return nothing without ends; one alone is told with a large sigma. Cost: square in their number.
std::optional<Estimate> common_end(const std::vector<Estimate>& ends, double outward);

}  // namespace stairway::detect
