// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <numbers>

namespace stairway::sim {

inline constexpr double kDegree = std::numbers::pi / 180.0;  ///< [rad]

/// The unit vector at `angle_rad` from x, counter-clockwise from above.
inline Eigen::Vector2d unit(double angle_rad) { return {std::cos(angle_rad), std::sin(angle_rad)}; }

}  // namespace stairway::sim
