// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tools/evaluation/experiment.hpp"

namespace stairway::evaluation {

/// Spirals (Fig 17 d): closed and open ones that turn left and right, in furnished rooms. Cost: 60 sweeps.
Result run_spiral(const Request& request);

/// Flights that go down from the robot's floor (Fig 17 c), seen from their upper edge. Cost: 40 sweeps.
Result run_descending(const Request& request);

}  // namespace stairway::evaluation
