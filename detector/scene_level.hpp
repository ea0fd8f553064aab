// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <optional>

namespace stairway::detect {

/// Which way is up, as floors, treads, ceilings, walls and risers of a scene say together.
struct SceneLevel {
  Eigen::Isometry3d T_level_cloud = Eigen::Isometry3d::Identity();  ///< the least turn that makes up z
  double roll_rad = 0.0;  ///< of the robot about x, left side up; p_level = Ry(pitch) Rx(roll) p but for a turn about z
  double pitch_rad = 0.0;  ///< of the robot about y, nose down
  double sigma_rad = 0.0;  ///< one standard deviation of either
  int planes = 0;          ///< that agree
  /// Angle of the floor against what the other planes say: the disagreement between them [rad]. Nothing without either.
  std::optional<double> floor_slope_rad;
  /// The floor around the robot as (a, b, c) of z = a x + b y + c in the levelled frame; nothing when none was seen.
  std::optional<Eigen::Vector3d> floor;

  /// Height of that floor at a place of the levelled frame, 0 without one [m].
  double floor_at(const Eigen::Vector3d& place) const;
};

}  // namespace stairway::detect
