// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>

#include "detector/railing.hpp"

namespace stairway::detect {

/// Looks for a thin bar along the stairway at hand height.
///
/// @param points  beside one end of the steps [m]: x along the line of nosings, y how far beyond the end, z above the
///                line (see FlightPoint); they reach max_thickness_m farther than handrails are looked for.
/// @return how far beyond the end of the steps it runs [m].
/// Cost: some hundred passes over the points.
std::optional<double> find_handrail(std::span<const Eigen::Vector3d> points, const RailingOptions& options);

}  // namespace stairway::detect
