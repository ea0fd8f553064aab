// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "tools/evaluation/experiment.hpp"

namespace stairway::evaluation {

/// One JSON object without line ends: "name", "seed", "share", "tables" (each with "name", "title", "columns" of "name"
/// and "unit", and "rows" of numbers, texts and null) and "notes". Numbers are not rounded; not finite ones are null.
std::string result_json(const Experiment& experiment, const Request& request, const Result& result);

}  // namespace stairway::evaluation
