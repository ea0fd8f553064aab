// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "detector/stair_fit.hpp"

#include <Eigen/Dense>
#include <cmath>
#include <unsupported/Eigen/NonLinearOptimization>
#include <unsupported/Eigen/NumericalDiff>

namespace stairway::detect {
namespace {

constexpr int kMostUnknowns = 6;
constexpr int kCostsPerPart = 3;

// The unknowns are changes from the model the fit starts at, so that all are small and of like size.
StairModel moved(const StairModel& start, const Eigen::VectorXd& change) {
  StairModel model = start;
  model.height_m += change[0];
  model.depth_m += change[1];
  model.descent = Eigen::AngleAxisd(change[2], Eigen::Vector3d::UnitZ()) * start.descent;
  model.nosing += change[3] * start.descent + change[4] * Eigen::Vector3d::UnitZ();
  if (start.is_spiral()) model.turn_rad += change[5];
  return model;
}

struct Costs {
  using Scalar = double;
  using InputType = Eigen::VectorXd;
  using ValueType = Eigen::VectorXd;
  using JacobianType = Eigen::MatrixXd;
  enum { InputsAtCompileTime = Eigen::Dynamic, ValuesAtCompileTime = Eigen::Dynamic };

  const StairGraph& graph;
  const std::vector<StairPart>& parts;
  View view;

  int inputs() const { return graph.model.is_spiral() ? kMostUnknowns : kMostUnknowns - 1; }
  int values() const { return static_cast<int>(graph.parts.size()) * kCostsPerPart; }

  // Eq 20: E = sum over risers of (delta_d + delta_h + delta_s) + sum over treads of (delta_d + delta_h).
  int operator()(const Eigen::VectorXd& change, Eigen::VectorXd& costs) const {
    const StairModel model = moved(graph.model, change);
    Eigen::Index row = 0;
    for (const GraphPart& entry : graph.parts) {
      const Deviation off = deviation(model, entry.step, parts[entry.part], view);
      costs[row++] = off.depth_m;
      costs[row++] = off.height_m;
      costs[row++] = off.direction_rad;
    }
    return 0;
  }
};

}  // namespace

StairFit fit_stairway(const StairGraph& graph, const std::vector<StairPart>& parts, View view) {
  StairFit fit{graph.model, {}};
  const Costs costs{graph, parts, view};
  if (costs.values() <= costs.inputs()) return fit;

  Eigen::VectorXd change = Eigen::VectorXd::Zero(costs.inputs());
  Eigen::NumericalDiff<Costs> differentiable(costs, 1e-12);
  Eigen::LevenbergMarquardt<Eigen::NumericalDiff<Costs>> solver(differentiable);
  solver.minimize(change);
  if (!change.allFinite()) return fit;
  fit.model = moved(graph.model, change);

  Eigen::VectorXd residuals(costs.values());
  Eigen::MatrixXd jacobian(costs.values(), costs.inputs());
  costs(change, residuals);
  differentiable.df(change, jacobian);
  const Eigen::MatrixXd information = jacobian.transpose() * jacobian;
  const Eigen::MatrixXd covariance = information.completeOrthogonalDecomposition().pseudoInverse() *
                                     (residuals.squaredNorm() / static_cast<double>(costs.values() - costs.inputs()));
  const Eigen::VectorXd sigmas = covariance.diagonal().cwiseMax(0.0).cwiseSqrt();
  fit.sigmas = {.height_m = sigmas[0], .depth_m = sigmas[1], .heading_rad = sigmas[2]};
  return fit;
}

}  // namespace stairway::detect
