// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "detector/stairway.hpp"
#include "scan_assembly/point_cloud.hpp"

namespace stairway::bench {

/// Ten steps straight ahead in a furnished room, in one turn of the disk: 1.5 million points, what a robot sees in 35
/// s.
scan::PointCloud take_sweep();
std::vector<detect::Stairway> sweep_truths();

/// What a robot has seen of a tower of offices after so many points: it goes from room to room and from storey to
/// storey and takes a sweep of 7 s at every stop, merged without error. More points are more rooms, not denser ones.
///
/// @param points  20 million at most; a cloud of fewer is the beginning of one of more.
/// Cost: about 2 s for every million points, and 1 s for every stop.
scan::PointCloud walk_through_tower(std::size_t points);
std::vector<detect::Stairway> tower_truths();

/// The truths by the name that the programs of the benchmark call a cloud by: "sweep" or "tower".
/// Throws std::invalid_argument for others.
std::vector<detect::Stairway> truths_of(const std::string& cloud);

}  // namespace stairway::bench
