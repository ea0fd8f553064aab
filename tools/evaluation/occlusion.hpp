// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tools/evaluation/experiment.hpp"

namespace stairway::evaluation {

/// A wall hides the right side of stairway III (Fig 11): how far its anchor is off, at the end whose railing is seen
/// and in the middle. Cost: 80 sweeps.
Result run_occlusion(const Request& request);

}  // namespace stairway::evaluation
