// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tools/evaluation/experiment.hpp"

namespace stairway::evaluation {

/// Buildings of several storeys, merged from many sweeps (Fig 21): flights found, time and memory over the number of
/// points. Cost: detection in up to some 10 million points.
Result run_large_scale(const Request& request);

}  // namespace stairway::evaluation
