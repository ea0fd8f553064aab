// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tools/evaluation/experiment.hpp"

namespace stairway::evaluation {

/// How exact the detector is in rooms drawn at random, case by case (accuracy_cases()), beside what is wanted, what the
/// sensor allows (accuracy_bound()) and what the detector itself says (its sigmas).
/// Cost: `scenes` sweeps per case and 100 in rooms without stairs; 40 scenes unless the request says how many.
Result run_accuracy(const Request& request);

}  // namespace stairway::evaluation
