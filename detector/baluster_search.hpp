// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>

#include "detector/railing.hpp"

namespace stairway::detect {

/// Looks for thin posts in a row along the stairway, each from knee to hand height.
///
/// @param points  as for find_handrail().
/// @return how far beyond the end of the steps the row runs [m], when it has min_balusters.
/// Cost: O(n log n) in the number of points.
std::optional<double> find_balusters(std::span<const Eigen::Vector3d> points, const RailingOptions& options);

}  // namespace stairway::detect
