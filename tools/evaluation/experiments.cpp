// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "tools/evaluation/experiment.hpp"

namespace stairway::evaluation {

std::span<const Experiment> experiments() { return {}; }

}  // namespace stairway::evaluation
