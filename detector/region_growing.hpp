// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <numbers>
#include <span>
#include <string>
#include <vector>

#include "detector/normals.hpp"
#include "detector/plane_region.hpp"

namespace stairway::detect {

struct RegionGrowingOptions {
  int num_neighbours = 12;                             ///< k of Alg. 1 [points], >= 3
  double max_normal_angle_rad = std::numbers::pi / 9;  ///< normal of a point against the region's [rad], in (0, pi/2)
  double max_plane_distance_m = 0.03;  ///< point to region plane, eq 1 [m], > 0; three times the range noise
  int min_points = 30;                 ///< a region must have more points than this (the paper's 30)

  std::string problem() const;
};

/// Segments a cloud into planar regions by growing them from the flattest points over nearest neighbours.
///
/// Centre and normal of a region are updated with every point it gains.
///
/// @param cloud    finite points [m].
/// @param surface  from estimate_normals(), in the order of `cloud`.
/// @return regions in the order of their seeds, each with the indices of its points; every point is in at most one.
/// Cost: O(N k) after the neighbours of all points were found at once (NeighbourLists): every point is asked for once,
/// so nothing is found in vain.
/// Method: Westfechtel et al. 2018, Alg. 1, eq 1.
std::vector<PlaneRegion> grow_regions(const scan::PointCloud& cloud, const SurfaceNormals& surface,
                                      const RegionGrowingOptions& options = {});

/// The same for points that stand for several each.
/// @param weights  how many every point of the cloud stands for, in a region's mean and against `min_points`.
/// @return the points of every region, its seed first.
std::vector<std::vector<std::uint32_t>> grow_point_sets(const scan::PointCloud& cloud, const SurfaceNormals& surface,
                                                        std::span<const std::uint32_t> weights,
                                                        const RegionGrowingOptions& options);

}  // namespace stairway::detect
