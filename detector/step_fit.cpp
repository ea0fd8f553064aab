// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "detector/step_fit.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <functional>

#include "detector/statistics.hpp"

namespace stairway::detect {
namespace {

// Changes of the model from where a pass of the fit begins, so that all are small and of like size.
enum Unknown {
  kAlong,
  kDepth,
  kHeight,
  kRise,
  kOverhang,
  kThickness,
  kHeading,
  kTurn,
  kTopBias,
  kSightBias,
  kBarBias,
  kUnknowns
};
using Unknowns = Eigen::Matrix<double, kUnknowns, 1>;

constexpr double kMostOverhang_m = 0.06;

StairModel moved(const StairModel& start, const Unknowns& change) {
  StairModel model = start;
  model.nosing += -change[kAlong] * start.descent + change[kHeight] * Eigen::Vector3d::UnitZ();
  model.depth_m += change[kDepth];
  model.height_m += change[kRise];
  // Held within what stairs have at every trial: cut off afterwards, the nosing would keep what it gave the overhang.
  model.overhang_m = std::clamp(start.overhang_m + change[kOverhang], 0.0, kMostOverhang_m);
  model.tread_thickness_m += change[kThickness];
  model.descent = Eigen::AngleAxisd(change[kHeading], Eigen::Vector3d::UnitZ()) * start.descent;
  if (start.is_spiral()) model.turn_rad += change[kTurn];
  return model;
}

struct Solution {
  Unknowns change = Unknowns::Zero();
  Unknowns sigmas = Unknowns::Zero();
};

/// Residuals over their sigmas, as a function of the unknowns.
using Residuals = std::function<Eigen::VectorXd(const Unknowns&)>;

Eigen::MatrixXd jacobian(const Residuals& residuals, const Unknowns& at) {
  constexpr double kStep = 1e-6;
  Eigen::MatrixXd result;
  for (int k = 0; k < kUnknowns; ++k) {
    const Unknowns step = kStep * Unknowns::Unit(k);
    const Eigen::VectorXd column = (residuals(at + step) - residuals(at - step)) / (2.0 * kStep);
    if (k == 0) result.resize(column.size(), kUnknowns);
    result.col(k) = column;
  }
  return result;
}

// Weights fall with the square of the residual beyond two sigmas, so outliers are set aside.
Eigen::VectorXd robust_weights(const Eigen::VectorXd& residuals) {
  constexpr double kInlier = 2.0;
  const double scale = std::max(1.0, robust_deviation({residuals.begin(), residuals.end()}, 0.0));
  return (residuals.cwiseAbs() / scale).unaryExpr([](double size) {
    return size < kInlier ? 1.0 : kInlier * kInlier / (size * size);
  });
}

// Gauss-Newton with the weights taken anew in each round. Unknowns that nothing depends on stay where they are.
Solution solve(const Residuals& residuals) {
  constexpr int kRounds = 6;
  using Matrix = Eigen::Matrix<double, kUnknowns, kUnknowns>;
  Solution solution;
  Eigen::VectorXd r = residuals(solution.change);
  Eigen::VectorXd weights = Eigen::VectorXd::Ones(r.size());
  Matrix information = Matrix::Zero();
  for (int round = 0; round < kRounds; ++round) {
    const Eigen::MatrixXd J = jacobian(residuals, solution.change);
    information = J.transpose() * weights.asDiagonal() * J;
    const Unknowns gradient = J.transpose() * weights.cwiseProduct(r);
    solution.change -= information.completeOrthogonalDecomposition().solve(gradient);
    r = residuals(solution.change);
    weights = robust_weights(r);
  }
  const double freedom = std::max(1.0, static_cast<double>(r.size()) - static_cast<double>(kUnknowns));
  const double misfit = std::max(1.0, weights.dot(r.cwiseAbs2()) / freedom);
  const Matrix covariance = information.completeOrthogonalDecomposition().pseudoInverse() * misfit;
  solution.sigmas = covariance.diagonal().cwiseMax(0.0).cwiseSqrt();
  return solution;
}

// What one measurement of a front or an edge may be off by for reasons its scatter does not show.
constexpr double kFrontFloor_m = 0.0005;
constexpr double kHeightFloor_m = 0.0003;

constexpr double kTurnFloor_rad = 0.0002;

constexpr double kGraphSigma_m = 0.010;
constexpr double kGraphSigma_rad = 0.03;
constexpr double kHeadingStep_rad = 0.1;
constexpr double kUsualTopBias_m = 0.015;
constexpr double kUsualOverhang_m = 0.015;
constexpr double kNoOverhang_m = 0.001;  // where there are no risers, what fronts there are are those of the treads
// Where within its spot a beam leaves an edge, and where between a bar and what lies behind it says it ends; the same
// for all steps, at an angle.
constexpr double kUsualSightBias_rad = 0.7e-3;
constexpr double kUsualBarBias_rad = 1.7e-3;
constexpr double kUsualThickness_m = 0.04;

// How far a measured step lies from that of a model, in sigmas.
class StepResiduals {
 public:
  StepResiduals(const StairModel& model, const Unknowns& change, std::vector<double>& residuals)
      : model_(model), change_(change), residuals_(residuals) {}

  void add(const StepMeasurement& step) {
    const StepFrame predicted = model_.step(step.number);
    const double rise = predicted.nosing.z() - step.frame.nosing.z();
    if (step.front) {
      const Eigen::Vector3d front = step.frame.from_step({step.front->value, step.middle_v, 0.0});
      const double u = predicted.to_step(front).u;
      // A bar is its own lip.
      const double expected = step.is_bar ? change_[kBarBias] * step.distance_m : model_.overhang_m;
      add(u - expected, step.front->sigma, kFrontFloor_m);
    }
    if (step.lip && !step.is_bar) {
      const Eigen::Vector3d lip = step.frame.from_step({step.lip->value, step.middle_v, 0.0});
      add(predicted.to_step(lip).u, step.lip->sigma, kFrontFloor_m);
    }
    if (step.turn) {
      const double turned = -predicted.descent.dot(step.frame.left());  // small angle
      add(turned + step.turn->value, step.turn->sigma, kTurnFloor_rad);
    }
    if (step.surface) add(step.surface->value - rise, step.surface->sigma, kHeightFloor_m);
    if (step.underside)
      add(step.underside->value + model_.tread_thickness_m - rise, step.underside->sigma, kHeightFloor_m);
    // Over a front the tread itself, where it is seen, tells the height better.
    if (step.nosing && !(step.nosing->over_a_front && step.surface)) {
      const StepPoint p = predicted.to_step(step.frame.from_step(step.nosing->at));
      const double bias = step.nosing->without_sight ? change_[kTopBias] : 0.0;
      const double off = (p.z - bias) * step.nosing->along_u - p.u * step.nosing->along_z;
      const double outwards = step.nosing->over_a_front ? change_[kSightBias] * step.nosing->distance_m : 0.0;
      add(off - outwards, step.nosing->sigma_m, kHeightFloor_m);
    }
  }

 private:
  void add(double residual, double sigma, double floor) { residuals_.push_back(residual / std::hypot(sigma, floor)); }

  const StairModel& model_;
  const Unknowns& change_;
  std::vector<double>& residuals_;
};

}  // namespace

StepFit fit_to_steps(const StairModel& start, const StairModel& prior, bool has_risers,
                     const std::vector<StepMeasurement>& steps) {
  const Solution solution = solve([&](const Unknowns& change) {
    const StairModel model = moved(start, change);
    std::vector<double> rows;
    // What the graph says keeps the unknowns that the points leave open.
    rows.push_back((model.depth_m - prior.depth_m) / kGraphSigma_m);
    rows.push_back((model.height_m - prior.height_m) / kGraphSigma_m);
    rows.push_back((model.turn_rad - prior.turn_rad) / kGraphSigma_rad);
    rows.push_back(model.overhang_m / (has_risers ? kUsualOverhang_m : kNoOverhang_m));
    rows.push_back((model.tread_thickness_m - kUsualThickness_m) / kUsualThickness_m);
    rows.push_back(change[kHeading] / kHeadingStep_rad);
    rows.push_back(change[kTopBias] / kUsualTopBias_m);
    rows.push_back(change[kSightBias] / kUsualSightBias_rad);
    rows.push_back(change[kBarBias] / kUsualBarBias_rad);
    StepResiduals of_steps(model, change, rows);
    for (const StepMeasurement& step : steps) of_steps.add(step);
    return Eigen::VectorXd(Eigen::Map<const Eigen::VectorXd>(rows.data(), static_cast<Eigen::Index>(rows.size())));
  });
  return {.model = moved(start, solution.change),
          .sigmas = {.height_m = solution.sigmas[kRise],
                     .depth_m = solution.sigmas[kDepth],
                     .heading_rad = solution.sigmas[kHeading]},
          .biases = {.sight_rad = solution.change[kSightBias], .bar_rad = solution.change[kBarBias]}};
}

}  // namespace stairway::detect
