// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "detector/joint_fit.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

namespace stairway::detect {
namespace {

// a + j d is the nosing of step j along the ascent, b + j h its height, o how far it stands out before its front, t the
// thickness of its tread.
enum Unknown { kNosing, kDepth, kHeight, kRise, kOverhang, kThickness, kUnknowns };
using Row = Eigen::Matrix<double, kUnknowns, 1>;

struct Observation {
  Row row;  ///< what multiplies the unknowns
  Estimate estimate;
};

struct Solution {
  Row unknowns;
  Row sigmas;
};

// Weighted least squares with outliers set aside (weights fall with the square of the residual beyond two sigmas).
Solution solve(const std::vector<Observation>& observations, const Row& start) {
  constexpr int kRounds = 6;
  using Matrix = Eigen::Matrix<double, kUnknowns, kUnknowns>;
  Solution solution{start, Row::Zero()};
  std::vector<double> weights(observations.size(), 1.0);
  for (int round = 0; round < kRounds; ++round) {
    Matrix information = Matrix::Zero();
    Row right = Row::Zero();
    for (std::size_t i = 0; i < observations.size(); ++i) {
      const auto& [row, estimate] = observations[i];
      const double weight = weights[i] / (estimate.sigma * estimate.sigma);
      information += weight * row * row.transpose();
      right += weight * row * (estimate.value - row.dot(start));
    }
    const Eigen::CompleteOrthogonalDecomposition<Matrix> solver(information);
    solution.unknowns = start + solver.solve(right);

    std::vector<double> sizes;
    for (const auto& [row, estimate] : observations)
      sizes.push_back(std::abs(estimate.value - row.dot(solution.unknowns)) / estimate.sigma);
    std::vector<double> sorted = sizes;
    std::nth_element(sorted.begin(), sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2), sorted.end());
    const double scale = std::max(1.0, 1.4826 * sorted[sorted.size() / 2]);
    double chi2 = 0.0;
    for (std::size_t i = 0; i < sizes.size(); ++i) {
      const double size = sizes[i] / scale;
      weights[i] = size < 2.0 ? 1.0 : 4.0 / (size * size);
      chi2 += weights[i] * sizes[i] * sizes[i];
    }
    const double freedom = std::max(1.0, static_cast<double>(observations.size()) - static_cast<double>(kUnknowns));
    const Matrix covariance = solver.pseudoInverse() * std::max(1.0, chi2 / freedom);
    solution.sigmas = covariance.diagonal().cwiseMax(0.0).cwiseSqrt();
  }
  return solution;
}

std::optional<Estimate> weighted_mean(const std::vector<Estimate>& estimates) {
  double w = 0.0, wx = 0.0;
  for (const Estimate& e : estimates) {
    w += 1.0 / (e.sigma * e.sigma);
    wx += e.value / (e.sigma * e.sigma);
  }
  if (w == 0.0) return std::nullopt;
  return Estimate{wx / w, std::sqrt(1.0 / w)};
}

// What one measurement of a front or an edge may be off by for reasons its scatter does not show.
constexpr double kFrontFloor_m = 0.0005;
constexpr double kHeightFloor_m = 0.001;

constexpr double kEndFloor_m = 0.003;
constexpr double kUnmeasuredEnd_m = 0.03;  // an end known from the parts alone
constexpr double kGraphSigma_m = 0.010;
constexpr double kUsualOverhang_m = 0.015;
constexpr double kMostOverhang_m = 0.06;
constexpr double kUsualThickness_m = 0.04;

class JointFitter {
 public:
  JointFitter(const scan::PointCloud& cloud, const StairGraph& graph, const Interval& side,
              const JointFitOptions& options)
      : options_(options), graph_model_(graph.model), corridor_(cloud, graph.model, side) {
    fit_.model = graph.model;
    fit_.side = side;
    fit_.first = graph.parts.front().step;
    fit_.last = graph.parts.back().step;
  }

  std::optional<JointFit> run() {
    for (int pass = 0; pass < options_.passes; ++pass) {
      if (!measure()) return std::nullopt;
      fit_steps();
      fit_direction();
      fit_sides();
    }
    return fit_;
  }

 private:
  std::vector<StepMeasurement> seen(int first, int last) const {
    std::vector<StepMeasurement> steps = corridor_.measure(fit_.model, fit_.side, first, last, options_.measurement);
    std::erase_if(steps, [&](const StepMeasurement& step) { return !step.seen() || is_ground(step.number); });
    return steps;
  }

  // The floor the robot stands on looks like a tread at z = 0, but is no step.
  bool is_ground(int number) const { return std::abs(fit_.model.step(number).nosing.z()) < 0.5 * fit_.model.height_m; }

  // Measures the known steps and looks for more beyond both ends.
  bool measure() {
    steps_ = seen(fit_.first, fit_.last);
    for (int direction : {+1, -1}) {
      int unseen = 0;
      for (int number = direction > 0 ? fit_.last + 1 : fit_.first - 1; unseen < options_.max_unseen_steps;
           number += direction) {
        if (is_ground(number)) break;
        if (std::abs(number) > 200) break;
        std::vector<StepMeasurement> more = seen(number, number);
        unseen = more.empty() ? unseen + 1 : 0;
        steps_.insert(steps_.end(), more.begin(), more.end());
      }
    }
    std::sort(steps_.begin(), steps_.end(),
              [](const StepMeasurement& a, const StepMeasurement& b) { return a.number < b.number; });
    keep_longest_run();
    if (steps_.size() < 2) return false;
    fit_.first = steps_.front().number;
    fit_.last = steps_.back().number;
    fit_.seen_steps = static_cast<int>(steps_.size());
    fit_.measurements = 0;
    for (const StepMeasurement& step : steps_)
      fit_.measurements += static_cast<int>(step.front.has_value()) + static_cast<int>(step.surface.has_value()) +
                           static_cast<int>(step.underside.has_value());
    return true;
  }

  // A graph may have taken in a part far beyond the last step; what follows a gap is another thing.
  void keep_longest_run() {
    std::size_t best_begin = 0;
    std::size_t best_end = 0;
    for (std::size_t begin = 0, end = 0; begin < steps_.size(); begin = end) {
      for (end = begin + 1;
           end < steps_.size() && steps_[end].number - steps_[end - 1].number <= options_.max_unseen_steps; ++end) {
      }
      if (end - begin > best_end - best_begin) {
        best_begin = begin;
        best_end = end;
      }
    }
    steps_.assign(steps_.begin() + static_cast<std::ptrdiff_t>(best_begin),
                  steps_.begin() + static_cast<std::ptrdiff_t>(best_end));
  }

  void fit_direction() {
    std::vector<Estimate> turns;
    for (const StepMeasurement& step : steps_)
      if (step.turn) turns.push_back(*step.turn);
    const std::optional<Estimate> turn = weighted_mean(turns);
    if (!turn) return;
    StairModel& model = fit_.model;
    const Eigen::Vector3d left = model.step(0).left();
    // Turn about the middle of the first nosing, where the fronts were measured.
    model.nosing += left * (fit_.side.middle() - model.nosing.dot(left));
    model.descent = (model.descent + turn->value * left).normalized();
    fit_.sigmas.heading_rad = turn->sigma;
    const double middle = model.nosing.dot(model.step(0).left());
    fit_.side = {middle - 0.5 * fit_.side.length(), middle + 0.5 * fit_.side.length()};
  }

  std::vector<Observation> observations() const {
    const StairModel& model = fit_.model;
    std::vector<Observation> rows;
    const auto add = [&](const Row& row, double value, double sigma, double floor) {
      rows.push_back({row, {value, std::hypot(sigma, floor)}});
    };
    // What the graph says keeps the unknowns that the points leave open.
    add(Row::Unit(kDepth), graph_model_.depth_m, kGraphSigma_m, 0.0);
    add(Row::Unit(kRise), graph_model_.height_m, kGraphSigma_m, 0.0);
    add(Row::Unit(kOverhang), 0.0, kUsualOverhang_m, 0.0);
    add(Row::Unit(kThickness), kUsualThickness_m, kUsualThickness_m, 0.0);
    for (const StepMeasurement& step : steps_) {
      const double j = step.number;
      Row nosing = Row::Zero();
      nosing[kNosing] = 1.0;
      nosing[kDepth] = j;
      const Row front = nosing + Row(Row::Unit(kOverhang));
      Row surface = Row::Zero();
      surface[kHeight] = 1.0;
      surface[kRise] = j;
      if (step.front) add(front, step.front->value, step.front->sigma, kFrontFloor_m);
      if (step.surface) add(surface, step.surface->value, step.surface->sigma, kHeightFloor_m);
      if (step.underside) {
        Row underside = surface;
        underside[kThickness] = -1.0;
        add(underside, step.underside->value, step.underside->sigma, kHeightFloor_m);
      }
      if (step.nosing && !step.surface) {
        // The line of sight rises by `slope`; the nosing lies on it, wherever along u that is.
        double slope = 0.0;
        double foot = step.nosing_u;
        if (const auto& sensor = corridor_.sensor()) {
          foot = -sensor->dot(model.descent);
          slope = (step.nosing->value - sensor->z()) / (step.nosing_u - foot);
        }
        add(surface - slope * nosing, step.nosing->value - slope * step.nosing_u, step.nosing->sigma, kHeightFloor_m);
      }
    }
    return rows;
  }

  void fit_steps() {
    const std::vector<Observation> rows = observations();
    if (rows.empty()) return;
    StairModel& model = fit_.model;
    const double place = -model.nosing.dot(model.descent);
    Row start;
    start << place, model.depth_m, model.nosing.z(), model.height_m, model.overhang_m, model.tread_thickness_m;
    const Solution solution = solve(rows, start);
    model.nosing -= model.descent * (solution.unknowns[kNosing] - place);
    model.nosing.z() = solution.unknowns[kHeight];
    model.depth_m = solution.unknowns[kDepth];
    model.height_m = solution.unknowns[kRise];
    model.overhang_m = std::clamp(solution.unknowns[kOverhang], 0.0, kMostOverhang_m);
    model.tread_thickness_m = solution.unknowns[kThickness];
    fit_.sigmas.depth_m = solution.sigmas[kDepth];
    fit_.sigmas.height_m = solution.sigmas[kRise];
  }

  // Posts and bystanders cut steps short, nothing makes them longer: the outer quartile of their ends is the flight's.
  static std::optional<Estimate> outer_end(std::vector<double> ends, double outward) {
    if (ends.size() < 2) return std::nullopt;
    std::sort(ends.begin(), ends.end(), [&](double a, double b) { return outward * a > outward * b; });
    const double end = ends[ends.size() / 4];
    double scatter = 0.0;
    for (std::size_t i = 0; i <= ends.size() / 2; ++i) scatter = std::max(scatter, std::abs(ends[i] - end));
    return Estimate{end, std::max(scatter / std::sqrt(static_cast<double>(ends.size())), kEndFloor_m)};
  }

  void fit_sides() {
    std::vector<double> rights;
    std::vector<double> lefts;
    for (const StepMeasurement& step : steps_) {
      if (step.right_end) rights.push_back(step.right_end->value);
      if (step.left_end) lefts.push_back(step.left_end->value);
    }
    const std::optional<Estimate> right = outer_end(std::move(rights), -1.0);
    const std::optional<Estimate> left = outer_end(std::move(lefts), +1.0);
    if (right) fit_.side.low = right->value;
    if (left) fit_.side.high = left->value;
    fit_.side_sigma_m = std::hypot(right ? right->sigma : kUnmeasuredEnd_m, left ? left->sigma : kUnmeasuredEnd_m);
  }

  const JointFitOptions& options_;
  const StairModel graph_model_;
  StairCorridor corridor_;
  JointFit fit_;
  std::vector<StepMeasurement> steps_;
};

}  // namespace

std::string JointFitOptions::problem() const {
  if (passes < 1) return "passes must be at least 1";
  if (max_unseen_steps < 1) return "max_unseen_steps must be at least 1";
  return measurement.problem();
}

std::optional<JointFit> fit_jointly(const scan::PointCloud& cloud, const StairGraph& graph, const Interval& side,
                                    const JointFitOptions& options) {
  return JointFitter(cloud, graph, side, options).run();
}

std::string broken_rule(const JointFit& fit, const StepLimits& limits, const ConfirmationOptions& confirmation,
                        const JointFitOptions& options) {
  if (std::string rule = broken_rule(fit.model, fit.seen_steps, confirmation); !rule.empty()) return rule;
  if (!limits.allow(fit.model.height_m, fit.model.depth_m)) return "step-size-out-of-range";
  if (fit.seen_steps < options.min_seen_share * (fit.last - fit.first + 1)) return "steps-missing";
  if (std::max(fit.sigmas.height_m, fit.sigmas.depth_m) > options.max_sigma_m) return "too-uncertain";
  return {};
}

}  // namespace stairway::detect
