// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "tools/evaluation/experiment.hpp"
#include "tools/sim/scene.hpp"

namespace stairway::evaluation {

/// The three segmentations against the true planes (the paper's Figs 15 and 16): 50 sweeps, each of one of the three
/// straight stairways, from 1 to 4.5 m before its first step, up to 45 degrees aside and up to 45 degrees askew.
/// Stairways are models as an STL file holds them; `request.model` takes the place of all three. Throws
/// std::runtime_error when that file cannot be used (stairway_model.hpp). Segmentations run one after the other and
/// alone, so that their times can be compared.
Result run_segmentation(const Request& request);

/// The scene of one of those sweeps: stairway number `position` modulo 3, placed by the seed and the position.
sim::SceneSpec segmentation_scene(std::uint64_t seed, int position);

}  // namespace stairway::evaluation
