// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <numbers>
#include <optional>
#include <string>

#include "scan_assembly/point_cloud.hpp"

namespace stairway::detect {

struct FloorOptions {
  double max_tilt_rad = std::numbers::pi / 12;  ///< of the floor against the cloud's own xy plane [rad], in (0, pi/2)
  double max_distance_m = 0.03;                 ///< of a floor point to the floor's plane [m], > 0
  double min_share = 0.02;                      ///< of all points must lie on the floor

  std::string problem() const;
};

/// The floor of a cloud, and the transform that makes it the plane z = 0.
struct FloorFit {
  Eigen::Isometry3d T_level_cloud = Eigen::Isometry3d::Identity();  ///< least turn that makes the floor's normal z
  double tilt_rad = 0.0;                                            ///< between the cloud's z and the floor's normal
  double share = 0.0;                                               ///< of all points on the floor
};

/// Turns gravity as measured in the cloud's frame (any length but 0, pointing down) to -z, with the least turn.
Eigen::Isometry3d upright_from_gravity(const Eigen::Vector3d& gravity);

/// Undoes a sensor's roll about x and pitch about y (positive: nose down), p_level = Ry(pitch) Rx(roll) p.
Eigen::Isometry3d upright_from_roll_pitch(double roll_rad, double pitch_rad);

/// Finds the lowest large plane that is nearly horizontal.
///
/// @param cloud  z roughly up [m].
/// @return nothing when no plane holds `min_share` of the points. Cost: one pass of normals over a thinned cloud.
std::optional<FloorFit> find_floor(const scan::PointCloud& cloud, const FloorOptions& options = {});

/// The cloud and its sensor in another frame.
scan::PointCloud transformed(const scan::PointCloud& cloud, const Eigen::Isometry3d& transform);

}  // namespace stairway::detect
