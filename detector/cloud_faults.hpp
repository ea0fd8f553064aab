// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "detector/plane_region.hpp"
#include "detector/stairway.hpp"
#include "scan_assembly/point_cloud.hpp"

namespace stairway::detect {

/// What about a cloud as a whole may have kept stairs from being found in it, worded for who recorded it.
///
/// Rules, the first that holds: "empty-cloud"; "units-suspicious", the cloud spans more than 500 m or less than 0.5 m;
/// "too-sparse", a step would not hold the points of a region; "cloud-tilted", the largest plane that is nearly level
/// is so by more than 15 degrees; "single-plane", one plane holds nearly all points.
///
/// @param cloud       as it came.
/// @param thinned     its thinned points, which were segmented; @param regions what they were segmented into.
/// @param min_points  of a region.
/// @return nothing when the cloud looks like a place that may have stairs.
/// Cost: O(N) and a sample of neighbour searches; meant for clouds in which nothing was found.
std::optional<Rejection> cloud_fault(const scan::PointCloud& cloud, const scan::PointCloud& thinned,
                                     const std::vector<PlaneRegion>& regions, int min_points);

}  // namespace stairway::detect
