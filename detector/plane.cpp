// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "detector/plane.hpp"

#include <Eigen/Eigenvalues>

namespace stairway::detect {

void PointMoments::add(const Eigen::Vector3f& point) {
  const Eigen::Vector3d p = point.cast<double>() - origin_;
  ++count_;
  sum_ += p;
  outer_.noalias() += p * p.transpose();
}

void PointMoments::add(const PointMoments& other) {
  if (other.count_ == 0) return;
  const Eigen::Vector3d shift = other.origin_ - origin_;
  const double n = static_cast<double>(other.count_);
  outer_ +=
      other.outer_ + shift * other.sum_.transpose() + other.sum_ * shift.transpose() + n * shift * shift.transpose();
  sum_ += other.sum_ + n * shift;
  count_ += other.count_;
}

Eigen::Vector3d PointMoments::mean() const {
  return count_ == 0 ? origin_ : Eigen::Vector3d(origin_ + sum_ / static_cast<double>(count_));
}

Eigen::Matrix3d PointMoments::covariance() const {
  if (count_ == 0) return Eigen::Matrix3d::Zero();
  const double n = static_cast<double>(count_);
  const Eigen::Vector3d mean = sum_ / n;
  return outer_ / n - mean * mean.transpose();
}

double PrincipalAxes::surface_variation() const {
  const double total = variances.sum();
  return total > 0.0 ? variances[2] / total : 0.0;
}

PrincipalAxes principal_axes(const PointMoments& moments) {
  if (moments.count() < 3) return {.centroid = moments.mean()};
  return principal_axes(moments.mean(), moments.covariance());
}

PrincipalAxes principal_axes(const Eigen::Vector3d& centroid, const Eigen::Matrix3d& covariance) {
  PrincipalAxes result;
  result.centroid = centroid;
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver;
  solver.computeDirect(covariance);
  result.axes = solver.eigenvectors().rowwise().reverse();
  // Rounding can push the smallest eigenvalue below zero.
  result.variances = solver.eigenvalues().reverse().cwiseMax(0.0);
  return result;
}

}  // namespace stairway::detect
