// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tools/evaluation/experiment.hpp"

namespace stairway::evaluation {

/// Single frames of a depth camera on a helmet (the paper's Table 3 and Fig 22): 89 with stairs, every other one going
/// down, and 58 without, the numbers of the Monash set, all times `share`.
///
/// Without `request.data` the frames are simulated (sim::random_helmet_scene), and the errors of height and depth are
/// told, too, which the paper's set has no truth for. With it the frames are those of the folder (depth_set.hpp).
/// The settings are those of the request when its profile is not the default one, else those of the profile
/// depth-camera. Throws std::runtime_error when the folder cannot be used.
Result run_depth_camera(const Request& request);

}  // namespace stairway::evaluation
