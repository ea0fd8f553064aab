// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>

#include "scan_assembly/frames.hpp"
#include "scan_assembly/point_cloud.hpp"
#include "tools/sim/scanner_model.hpp"
#include "tools/sim/scene.hpp"
#include "tools/sim/sweep.hpp"

namespace stairway::sim {

/// Where a robot stands level to take a sweep, in the scene frame.
struct Stand {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< of its `base`, on the floor it stands on [m]
  double yaw_rad = 0.0;                                ///< from x of the scene to its own, counter-clockwise
};

/// Takes one sweep at every stand and merges them into one cloud in the scene frame, as registration without error
/// would.
///
/// @return Points in the order of the stands; no sensor_origin, for there are several. Noise depends on the seed and
/// the number of the stand. Cost: that of simulate_sweep() per stand; `options.disk_period_s` sets the number of
/// points, about 40000 per second and stand.
scan::PointCloud simulate_merged(const Scene& scene, std::span<const Stand> stands, const scan::MountOptions& mount,
                                 const ScannerOptions& scanner, const SweepOptions& options, std::uint64_t seed);

}  // namespace stairway::sim
