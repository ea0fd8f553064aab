// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "tools/sim/outline.hpp"

namespace stairway::sim {

/// A flat piece of a surface. Triangles of one object that lie in one plane share their surface id.
struct Triangle {
  std::array<Eigen::Vector3d, 3> corners;  ///< [m]
  std::uint32_t surface = 0;

  /// Of unit length, towards the side from which the corners turn left.
  Eigen::Vector3d normal() const { return (corners[1] - corners[0]).cross(corners[2] - corners[0]).normalized(); }
};

/// What a beam can hit: triangles without inside or outside, in one frame [m].
class Mesh {
 public:
  const std::vector<Triangle>& triangles() const { return triangles_; }
  std::uint32_t surface_count() const { return surface_count_; }

  /// A flat convex polygon, one new surface.
  void add_polygon(std::span<const Eigen::Vector3d> corners);
  /// A horizontal polygon at height `z_m`, one new surface.
  void add_horizontal(const Outline& outline, double z_m) { add_horizontal(std::vector<Outline>{outline}, z_m); }
  /// The same in pieces that together are one surface.
  void add_horizontal(const std::vector<Outline>& pieces, double z_m);
  /// Vertical walls along the sides of `outline`, each its own surface.
  void add_walls(const Outline& outline, double z_low_m, double z_high_m);
  /// Walls, top and bottom.
  void add_prism(const Outline& outline, double z_low_m, double z_high_m);
  /// A box that stands on `z_low_m`.
  void add_box(const Eigen::Vector2d& center, double z_low_m, const Eigen::Vector3d& size, double yaw_rad);
  /// A slanted beam with a rectangular section, its width horizontal. `from` and `to` are the middles of its ends.
  void add_beam(const Eigen::Vector3d& from, const Eigen::Vector3d& to, double width_m, double height_m);
  /// An upright round post, approximated by `sides` facets.
  void add_post(const Eigen::Vector2d& center, double z_low_m, double z_high_m, double radius_m, int sides = 8);
  /// All of `other`, moved by `T_this_other`; its surfaces stay apart from those that are here.
  void append(const Mesh& other, const Eigen::Isometry3d& T_this_other = Eigen::Isometry3d::Identity());
  /// Gives triangles that lie in one plane the same surface. For one object at a time; the cost is quadratic in its
  /// surfaces.
  void share_coplanar_surfaces();

 private:
  void add_fan(std::span<const Eigen::Vector3d> corners, std::uint32_t surface);

  std::vector<Triangle> triangles_;
  std::uint32_t surface_count_ = 0;
};

}  // namespace stairway::sim
