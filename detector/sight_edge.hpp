// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

namespace stairway::detect {

/// A line of sight that crosses a surface, or passes its edge, at `place` along some axis.
struct Crossing {
  double place = 0.0;
  bool on = false;  ///< it ended on the surface
};

/// Where an edge lies, and how well that is known.
struct SightEdge {
  double place = 0.0;
  double sigma = 0.0;  ///< from the gap between the nearest crossings, and from those on the wrong side
};

/// The place of an edge: lines of sight end on the surface below it and pass beyond above it.
///
/// The split that leaves the fewest crossings on the wrong side wins, half way between its neighbours; the middle of
/// several that are as good.
/// @param crossings  of one strip; sorted by place when this returns.
/// @return nothing for fewer than four, when all are alike, or when a quarter of them lie on the wrong side.
/// Cost: O(n log n).
std::optional<SightEdge> edge_between(std::vector<Crossing>& crossings);

}  // namespace stairway::detect
