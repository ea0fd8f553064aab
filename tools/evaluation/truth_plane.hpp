// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <array>
#include <span>
#include <vector>

#include "tools/sim/mesh.hpp"

namespace stairway::evaluation {

/// A flat surface of the ground truth: triangles that lie in one plane and hang together [m].
class TruthPlane {
 public:
  /// Triangles of one plane. Their first edge gives the first axis of the plane's own coordinates.
  explicit TruthPlane(std::span<const sim::Triangle> triangles);

  const Eigen::Vector3d& normal() const { return normal_; }  ///< of length 1, to either side

  /// Coordinates in the plane of the foot of the perpendicular from `point`.
  Eigen::Vector2d flatten(const Eigen::Vector3d& point) const;
  Eigen::Vector3d place(const Eigen::Vector2d& flat) const;  ///< the way back
  /// Distance to the infinite plane, signed towards the normal [m].
  double height(const Eigen::Vector3d& point) const { return (point - origin_).dot(normal_); }
  bool holds(const Eigen::Vector2d& flat) const;  ///< whether the surface covers this place
  /// The place of the surface nearest to `flat`.
  Eigen::Vector2d nearest(const Eigen::Vector2d& flat) const;

  /// Places of the surface on a raster, at least `margin_m` from its border (eight directions are looked at).
  std::vector<Eigen::Vector2d> raster(double step_m, double margin_m) const;

 private:
  using FlatTriangle = std::array<Eigen::Vector2d, 3>;

  Eigen::Vector3d origin_, normal_, u_, v_;
  std::vector<FlatTriangle> triangles_;  // all turning left
  Eigen::Vector2d low_, high_;
};

/// Joins triangles that lie in one plane, to 10 um, whichever side they face, and share part of an edge (the paper's
/// section "Ground Truth Generation"; it asks for equal or opposite normals, which corners in single precision do not
/// give). Planes come in the order of their first triangles. Cost: quadratic in the triangles.
std::vector<TruthPlane> truth_planes(std::span<const sim::Triangle> triangles);

}  // namespace stairway::evaluation
