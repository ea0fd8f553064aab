// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "ipc/stairway_json.hpp"

namespace stairway::ipc {

/// The answer for one cloud as lines for a person: a heading, a table with one row per stairway, and why candidates
/// failed. Ends with a line end. Lengths in mm, angles in degrees, `base` frame; `+-` is one standard deviation.
std::string detection_text(std::string_view source, std::size_t points, const Timings& timings,
                           const detect::Detection& detection);

}  // namespace stairway::ipc
