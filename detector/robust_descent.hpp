// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <functional>

namespace stairway::detect {

// Pieces of a robust least-squares fit whose residuals may jump: rows in sigmas, NaN where nobody can tell.

/// Tukey's biweight: 1 for a residual of 0, 0 from `kernel_sigmas` on.
double biweight(double residual, double kernel_sigmas);

/// By how much the robust chi^2 falls from `before` to `after`; rows that are not finite in both do not count.
double robust_gain(const Eigen::VectorXd& after, const Eigen::VectorXd& before, double kernel_sigmas);

/// The normal equations of one round, which begin with what is known beforehand.
struct NormalEquations {
  Eigen::MatrixXd information;
  Eigen::VectorXd gradient;

  /// One standard deviation of each unknown.
  Eigen::VectorXd sigmas() const;
};

/// Adds the rows `r` with their derivatives `J`, by weight.
/// @param reach  over which J was taken by differences: a row that jumps by more than 3 sigmas over it is left out, for
///               its derivative says nothing about what lies beyond the jump.
void add_rows(const Eigen::VectorXd& r, const Eigen::MatrixXd& J, double kernel_sigmas, double reach,
              NormalEquations& normal);

/// Levenberg and Marquardt: ever shorter and steeper steps until one is taken. @param take  says whether it was.
void damped_descent(const NormalEquations& normal, const std::function<bool(const Eigen::VectorXd&)>& take);

}  // namespace stairway::detect
