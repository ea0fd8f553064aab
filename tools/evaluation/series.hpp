// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tools/evaluation/experiment.hpp"

namespace stairway::evaluation {

/// The paper's measurement series (Fig 18, Table 2): errors over the distance at stairways I and III, with its
/// optimizing strategy and with the joint fit. Cost: 260 sweeps, each detected in twice.
Result run_series(const Request& request);

}  // namespace stairway::evaluation
