// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tools/evaluation/experiment.hpp"

namespace stairway::evaluation {

/// The ways in which initialisations compete (Figs 19 and 20), on a part of the sweeps of the series: errors of height
/// and depth, and the time that the graph takes. Cost: 70 sweeps, each detected in four times.
Result run_strategies(const Request& request);

}  // namespace stairway::evaluation
