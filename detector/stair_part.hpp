// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <cstddef>

namespace stairway::detect {

/// The underside of a tread hides its top; this is a common thickness, to be replaced by what a whole graph says [m].
inline constexpr double kTypicalTreadThickness_m = 0.04;

/// A plane region that looks like a part of a step (P_r/t of the paper). All in the frame of the cloud, z up.
///
/// The outline is the rectangle that a robust measure of the region's extents gives, in the plane's own axes:
/// one point in the middle of each of its edges.
struct StairPart {
  enum class Kind {
    Riser,
    Tread,
    Edge,  ///< ours: a bar along the nosing, all that is left of an open tread seen from afar
  };

  Kind kind = Kind::Riser;
  bool from_below = false;  ///< a tread seen from below: its underside
  Eigen::Vector3d centroid = Eigen::Vector3d::Zero();
  /// Riser and edge: the horizontal unit normal. Tread: the horizontal unit direction of its depth, the second
  /// eigenvector u.
  Eigen::Vector3d facing = Eigen::Vector3d::UnitX();
  Eigen::Vector3d top = Eigen::Vector3d::Zero();     ///< riser: middle of the top edge; else the centroid
  Eigen::Vector3d bottom = Eigen::Vector3d::Zero();  ///< riser: middle of the bottom edge; else the centroid
  Eigen::Vector3d front = Eigen::Vector3d::Zero();   ///< middle of the edge farthest along `facing`
  Eigen::Vector3d back = Eigen::Vector3d::Zero();    ///< middle of the opposite edge
  Eigen::Vector3d end_a = Eigen::Vector3d::Zero();   ///< middle of one lateral edge
  Eigen::Vector3d end_b = Eigen::Vector3d::Zero();   ///< middle of the other
  std::size_t region = 0;                            ///< index of the region it was made from
  std::size_t point_count = 0;

  double width() const { return (end_b - end_a).norm(); }
};

}  // namespace stairway::detect
