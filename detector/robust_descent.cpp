// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "detector/robust_descent.hpp"

#include <Eigen/Dense>
#include <cmath>

namespace stairway::detect {

double biweight(double residual, double kernel_sigmas) {
  const double x = residual / kernel_sigmas;
  return std::abs(x) >= 1.0 ? 0.0 : (1.0 - x * x) * (1.0 - x * x);
}

double robust_gain(const Eigen::VectorXd& after, const Eigen::VectorXd& before, double kernel_sigmas) {
  const auto cost = [&](double r) {
    const double x = r / kernel_sigmas;
    const double left = 1.0 - x * x;
    return left > 0.0 ? 1.0 - left * left * left : 1.0;
  };
  double gain = 0.0;
  for (Eigen::Index i = 0; i < before.size(); ++i)
    if (std::isfinite(before[i]) && std::isfinite(after[i])) gain += cost(before[i]) - cost(after[i]);
  return gain * kernel_sigmas * kernel_sigmas / 3.0;
}

void add_rows(const Eigen::VectorXd& r, const Eigen::MatrixXd& J, double kernel_sigmas, double reach,
              NormalEquations& normal) {
  constexpr double kJump = 3.0;
  Eigen::MatrixXd weighted(J.cols() + 1, r.size());
  Eigen::Index rows = 0;
  for (Eigen::Index i = 0; i < r.size(); ++i) {
    const double weight = std::isfinite(r[i]) ? biweight(r[i], kernel_sigmas) : 0.0;
    if (weight == 0.0) continue;
    auto row = weighted.col(rows);
    row << J.row(i).transpose(), r[i];
    if (!row.allFinite() || row.head(J.cols()).cwiseAbs().maxCoeff() * reach > kJump) continue;
    row *= std::sqrt(weight);
    ++rows;
  }
  const auto kept = weighted.leftCols(rows);
  normal.information.noalias() += kept.topRows(J.cols()) * kept.topRows(J.cols()).transpose();
  normal.gradient.noalias() += kept.topRows(J.cols()) * kept.bottomRows(1).transpose();
}

Eigen::VectorXd NormalEquations::sigmas() const { return information.inverse().diagonal().cwiseMax(0.0).cwiseSqrt(); }

void damped_descent(const NormalEquations& normal, const std::function<bool(const Eigen::VectorXd&)>& take) {
  for (const double damping : {0.0, 0.3, 3.0}) {
    Eigen::MatrixXd damped = normal.information;
    damped.diagonal() *= 1.0 + damping;
    if (take(-damped.ldlt().solve(normal.gradient))) return;
  }
}

}  // namespace stairway::detect
