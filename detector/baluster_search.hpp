// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <span>

#include "detector/railing.hpp"

namespace stairway::detect {

/// How many thin posts stand in a row along the stairway, each from knee to hand height.
///
/// @param points  as for has_handrail().
/// Cost: O(n log n) in the number of points.
int count_balusters(std::span<const Eigen::Vector3d> points, const RailingOptions& options);

}  // namespace stairway::detect
