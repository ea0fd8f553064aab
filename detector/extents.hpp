// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>

namespace stairway::detect {

struct Interval {
  double low = 0.0;
  double high = 0.0;
  double length() const { return high - low; }
  double middle() const { return 0.5 * (low + high); }
};

/// Length by which two intervals overlap; negative when there is a gap.
double overlap(const Interval& a, const Interval& b);

/// Where a region begins and ends along `axis`, unmoved by a few stray points or a corner that something hides.
///
/// The region is cut into strips along `axis`, `strip_m` wide across; the answer is the median of the strips' ends.
///
/// @param points  all points of the cloud [m]; @param chosen the region's indices into it, not empty.
/// @param axis    unit direction to measure along; @param across unit direction to cut along.
/// Cost: O(n log n) in the number of chosen points.
Interval robust_extent(std::span<const Eigen::Vector3f> points, std::span<const std::uint32_t> chosen,
                       const Eigen::Vector3d& axis, const Eigen::Vector3d& across, double strip_m);

/// From the first to the last point along `axis`.
Interval full_extent(std::span<const Eigen::Vector3f> points, std::span<const std::uint32_t> chosen,
                     const Eigen::Vector3d& axis);

}  // namespace stairway::detect
