// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "detector/plane_finder.hpp"
#include "detector/plane_region.hpp"
#include "detector/stair_part.hpp"
#include "scan_assembly/point_cloud.hpp"

namespace stairway::detect {

/// Treads of which a robot above a descent sees a few centimetres only, beyond the nosing before each.
///
/// Strips about as narrow as the noise is wide have no normals to grow a region by; but all their points lie at one
/// height, apart from those of other treads. Looked for among the points below the floor that belong to no tread and
/// no larger plane.
///
/// @param cloud    level, the floor at z = 0 [m].
/// @param regions  of it, as they were grown.
/// @return the treads, with the numbers of regions that would follow the given ones; none where nothing is seen below
/// the floor. Cost: O(n) in the points below the floor. Not in the paper, see docs/architecture.md.
std::vector<StairPart> find_level_strips(const scan::PointCloud& cloud, const std::vector<PlaneRegion>& regions,
                                         const PlaneFinderOptions& options);

}  // namespace stairway::detect
