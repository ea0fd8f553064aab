// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "detector/stairway.hpp"

namespace stairway::ipc {

/// Durations by name, in the order to show them [ms]: "total" from the points in memory to the answer, "read" from the
/// file to memory, and one per stage.
using Timings = std::vector<std::pair<std::string, double>>;

/// The answer for one cloud as a JSON object on one line, without a line end.
///
/// Metres and radians in the `base` frame, rounded to 1e-6 (micrometres, microradians); milliseconds to 1e-3. What is
/// not finite becomes null. Bytes of `source` that are not UTF-8 are replaced, so the line is valid JSON whatever the
/// file was called.
std::string detection_json(std::string_view source, std::size_t points, const Timings& timings,
                           const detect::Detection& detection);

}  // namespace stairway::ipc
