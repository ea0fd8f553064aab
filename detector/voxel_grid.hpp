// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "detector/cell_groups.hpp"
#include "scan_assembly/point_cloud.hpp"

namespace stairway::detect {

/// Thins a cloud to one point, the centroid, per occupied cubic cell (the paper's preprocessing, section
/// "Segmentation").
///
/// The result is ordered by cell, so it does not depend on the order of the input beyond the rounding of sums.
///
/// @param cloud   points in any frame [m]; non-finite ones, and those farther than 10 km from the origin, are left out.
/// @param leaf_m  edge of a cell [m], > 0.
/// @return cell centroids [m] with the sensor origin of the input; empty for an empty cloud.
/// Cost: O(N) radix sort of the cell keys.
scan::PointCloud voxel_centroids(const scan::PointCloud& cloud, double leaf_m);
/// The same for cells that the points were grouped by before.
scan::PointCloud centroids(const scan::PointCloud& cloud, const CellGroups& cells);

}  // namespace stairway::detect
