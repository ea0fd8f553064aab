// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "detector/normals.hpp"
#include "scan_assembly/point_cloud.hpp"

namespace stairway::detect {

/// Drops points whose surface is seen at less than `min_grazing_rad` [rad] from within it, and their normals.
///
/// Where a beam's spot falls on two surfaces, its range lies between them. Such ghosts line up along the line of sight
/// and span what lies behind an edge, so that the treads of a descent would look like one ramp.
/// @return which points are left, as indices into the cloud as it was. A cloud without sensor origin keeps all.
/// Cost: O(N).
/// Source: a filter of the paper's published program; the paper itself does not mention it.
std::vector<std::uint32_t> drop_ghosts(scan::PointCloud& cloud, SurfaceNormals& surface, double min_grazing_rad);

}  // namespace stairway::detect
