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
    return std::abs(x) < 1.0 ? 1.0 - std::pow(1.0 - x * x, 3) : 1.0;
  };
  double gain = 0.0;
  for (Eigen::Index i = 0; i < before.size(); ++i)
    if (std::isfinite(before[i]) && std::isfinite(after[i])) gain += cost(before[i]) - cost(after[i]);
  return gain * kernel_sigmas * kernel_sigmas / 3.0;
}

Eigen::VectorXd NormalEquations::sigmas() const { return information.inverse().diagonal().cwiseMax(0.0).cwiseSqrt(); }

void add_rows(const Eigen::VectorXd& r, const Eigen::MatrixXd& J, double kernel_sigmas, double reach,
              NormalEquations& normal) {
  constexpr double kJump = 3.0;
  for (Eigen::Index i = 0; i < r.size(); ++i) {
    if (!std::isfinite(r[i]) || !J.row(i).allFinite() || J.row(i).cwiseAbs().maxCoeff() * reach > kJump) continue;
    const double weight = biweight(r[i], kernel_sigmas);
    normal.information.selfadjointView<Eigen::Lower>().rankUpdate(J.row(i).transpose(), weight);
    normal.gradient += weight * r[i] * J.row(i).transpose();
  }
  normal.information = Eigen::MatrixXd(normal.information.selfadjointView<Eigen::Lower>());
}

void damped_descent(const NormalEquations& normal, const std::function<bool(const Eigen::VectorXd&)>& take) {
  for (const double damping : {0.0, 0.03, 0.3, 3.0, 30.0}) {
    Eigen::MatrixXd damped = normal.information;
    damped.diagonal() *= 1.0 + damping;
    if (take(-damped.ldlt().solve(normal.gradient))) return;
  }
}

}  // namespace stairway::detect
