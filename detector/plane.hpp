// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstddef>

namespace stairway::detect {

/// Running sums of a set of points, enough to fit a plane to it and to merge two sets (doubles, about a local origin).
class PointMoments {
 public:
  /// Sums are taken relative to `origin`, a point near the set, so that no digits are lost far from zero.
  explicit PointMoments(const Eigen::Vector3d& origin = Eigen::Vector3d::Zero()) : origin_(origin) {}

  void add(const Eigen::Vector3f& point);
  /// Adds another set; its origin may differ.
  void add(const PointMoments& other);

  std::size_t count() const { return count_; }
  Eigen::Vector3d mean() const;
  /// Second central moments, divided by the count [m^2].
  Eigen::Matrix3d covariance() const;

 private:
  Eigen::Vector3d origin_;
  std::size_t count_ = 0;
  Eigen::Vector3d sum_ = Eigen::Vector3d::Zero();
  Eigen::Matrix3d outer_ = Eigen::Matrix3d::Zero();
};

/// The principal axes of a set of points (the paper's PCA).
struct PrincipalAxes {
  Eigen::Vector3d centroid = Eigen::Vector3d::Zero();
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();   ///< columns: first, second, third (the plane's normal)
  Eigen::Vector3d variances = Eigen::Vector3d::Zero();  ///< along the columns, falling [m^2]
  Eigen::Vector3d normal() const { return axes.col(2); }
  /// Share of the variance that lies off the plane, the paper's "curvature", in [0, 1/3].
  double surface_variation() const;
};

/// Principal axes of at least three points; with fewer the axes are those of the frame.
PrincipalAxes principal_axes(const PointMoments& moments);
/// Principal axes of a set with this mean and these second central moments [m^2].
PrincipalAxes principal_axes(const Eigen::Vector3d& centroid, const Eigen::Matrix3d& covariance);

}  // namespace stairway::detect
