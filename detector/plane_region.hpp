// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "detector/plane.hpp"
#include "scan_assembly/point_cloud.hpp"

namespace stairway::detect {

/// A planar region of a segmented cloud.
struct PlaneRegion {
  std::vector<std::uint32_t> points;  ///< indices into the segmented cloud
  PrincipalAxes axes;                 ///< of those points; the normal faces the sensor when its place was known
};

/// The region of the given points with its principal axes.
/// @param facing  the normal is turned to the side of this direction.
PlaneRegion make_region(std::span<const Eigen::Vector3f> cloud, std::vector<std::uint32_t> points,
                        const Eigen::Vector3d& facing);
/// The same, with the normal turned to the cloud's sensor where its place is known.
PlaneRegion make_region(const scan::PointCloud& cloud, std::vector<std::uint32_t> points);

}  // namespace stairway::detect
