// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace stairway::detect {

// How far from the place where a model has them the faces of a step are looked for.
inline constexpr double kEdgeReach_m = 0.09;   ///< an edge, from its place
inline constexpr double kEndReach_m = 0.4;     ///< the ends of a step
inline constexpr double kEndBand_m = 0.10;     ///< ends are measured on this much of a face, from the nosing
inline constexpr double kFrontReach_m = 0.07;  ///< a point ends a line of sight on a front within this distance
inline constexpr double kLandingNear =
    0.7;  ///< a landing goes on this share of a depth before a nosing, beyond any tread
inline constexpr double kLandingFar = 1.5;    ///< and at least to here
inline constexpr double kClearance_m = 0.03;  ///< the sensor sees a face only from this far before or above it

}  // namespace stairway::detect
