// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "detector/joint_fit.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace stairway::detect {
namespace {

struct Observation {
  int number;
  Estimate estimate;
};

/// value = offset + slope * number, weighted by the sigmas, with outliers set aside.
struct Line {
  double offset;
  double slope;
  double slope_sigma;
};

std::optional<Line> fit_line(std::vector<Observation> observations, double floor) {
  for (Observation& o : observations) o.estimate.sigma = std::hypot(o.estimate.sigma, floor);
  std::optional<Line> line;
  std::vector<double> weights(observations.size(), 1.0);
  for (int round = 0; round < 5; ++round) {
    double w = 0.0, wx = 0.0, wy = 0.0, wxx = 0.0, wxy = 0.0;
    for (std::size_t i = 0; i < observations.size(); ++i) {
      const double weight = weights[i] / (observations[i].estimate.sigma * observations[i].estimate.sigma);
      const double x = observations[i].number;
      const double y = observations[i].estimate.value;
      w += weight;
      wx += weight * x;
      wy += weight * y;
      wxx += weight * x * x;
      wxy += weight * x * y;
    }
    const double determinant = w * wxx - wx * wx;
    if (!(determinant > 1e-9 * w * w)) return std::nullopt;
    line = Line{(wxx * wy - wx * wxy) / determinant, (w * wxy - wx * wy) / determinant, 0.0};
    double chi2 = 0.0;
    std::vector<double> sizes;
    for (const Observation& o : observations)
      sizes.push_back(std::abs(o.estimate.value - line->offset - line->slope * o.number) / o.estimate.sigma);
    std::vector<double> sorted = sizes;
    std::nth_element(sorted.begin(), sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2), sorted.end());
    const double scale = std::max(1.0, 1.4826 * sorted[sorted.size() / 2]);
    for (std::size_t i = 0; i < sizes.size(); ++i) {
      const double size = sizes[i] / scale;
      weights[i] = size < 2.0 ? 1.0 : 4.0 / (size * size);
      chi2 += weights[i] * sizes[i] * sizes[i];
    }
    const double freedom = std::max(1.0, static_cast<double>(observations.size()) - 2.0);
    line->slope_sigma = std::sqrt(w / determinant * std::max(1.0, chi2 / freedom));
  }
  return line;
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

class JointFitter {
 public:
  JointFitter(const scan::PointCloud& cloud, const StairGraph& graph, const JointFitOptions& options)
      : options_(options), corridor_(cloud, graph.model, graph.side) {
    fit_.model = graph.model;
    fit_.side = graph.side;
    fit_.first = graph.parts.front().step;
    fit_.last = graph.parts.back().step;
  }

  std::optional<JointFit> run() {
    for (int pass = 0; pass < options_.passes; ++pass) {
      if (!measure()) return std::nullopt;
      fit_depths();
      fit_heights();
      fit_sides();
    }
    if (!measure()) return std::nullopt;
    fit_depths();
    fit_heights();
    fit_sides();
    return fit_;
  }

 private:
  std::vector<StepMeasurement> seen(int first, int last) const {
    std::vector<StepMeasurement> steps = corridor_.measure(fit_.model, fit_.side, first, last, options_.measurement);
    std::erase_if(steps, [](const StepMeasurement& step) { return !step.seen(); });
    return steps;
  }

  // Measures the known steps and looks for more beyond both ends.
  bool measure() {
    steps_ = seen(fit_.first, fit_.last);
    for (int direction : {+1, -1}) {
      int unseen = 0;
      for (int number = direction > 0 ? fit_.last + 1 : fit_.first - 1; unseen < options_.max_unseen_steps;
           number += direction) {
        const double height = fit_.model.step(number).nosing.z();
        if (direction < 0 && std::abs(height) < 0.5 * fit_.model.height_m) break;  // the floor itself
        if (std::abs(number) > 200) break;
        std::vector<StepMeasurement> more = seen(number, number);
        unseen = more.empty() ? unseen + 1 : 0;
        steps_.insert(steps_.end(), more.begin(), more.end());
      }
    }
    if (steps_.size() < 2) return false;
    std::sort(steps_.begin(), steps_.end(),
              [](const StepMeasurement& a, const StepMeasurement& b) { return a.number < b.number; });
    fit_.first = steps_.front().number;
    fit_.last = steps_.back().number;
    fit_.seen_steps = static_cast<int>(steps_.size());
    return true;
  }

  void fit_depths() {
    std::vector<Observation> fronts;
    std::vector<Estimate> turns;
    for (const StepMeasurement& step : steps_) {
      if (step.front) fronts.push_back({step.number, *step.front});
      if (step.turn) turns.push_back(*step.turn);
    }
    StairModel& model = fit_.model;
    const Eigen::Vector3d left = model.step(0).left();
    if (fronts.size() >= 2) {
      if (const std::optional<Line> line = fit_line(fronts, kFrontFloor_m)) {
        model.depth_m = line->slope;
        fit_.sigmas.depth_m = line->slope_sigma;
        model.nosing -= model.descent * (line->offset + model.nosing.dot(model.descent));
      }
    }
    if (const std::optional<Estimate> turn = weighted_mean(turns)) {
      // Turn about the middle of the first nosing, where the fronts were measured.
      model.nosing += left * (fit_.side.middle() - model.nosing.dot(left));
      model.descent = (model.descent + turn->value * left).normalized();
      fit_.sigmas.heading_rad = turn->sigma;
      const double middle = model.nosing.dot(model.step(0).left());
      fit_.side = {middle - 0.5 * fit_.side.length(), middle + 0.5 * fit_.side.length()};
    }
  }

  void fit_heights() {
    std::vector<Observation> heights;
    for (const StepMeasurement& step : steps_) {
      if (step.surface)
        heights.push_back({step.number, *step.surface});
      else if (step.nosing)
        heights.push_back({step.number, *step.nosing});
    }
    if (heights.size() < 2) return;
    const std::optional<Line> line = fit_line(heights, kHeightFloor_m);
    if (!line) return;
    fit_.model.height_m = line->slope;
    fit_.sigmas.height_m = line->slope_sigma;
    fit_.model.nosing.z() = line->offset;
  }

  void fit_sides() {
    std::vector<double> rights;
    std::vector<double> lefts;
    for (const StepMeasurement& step : steps_) {
      if (step.right_end) rights.push_back(step.right_end->value);
      if (step.left_end) lefts.push_back(step.left_end->value);
    }
    const auto middle_of = [](std::vector<double>& values) {
      std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2), values.end());
      return values[values.size() / 2];
    };
    if (rights.size() >= 2) fit_.side.low = middle_of(rights);
    if (lefts.size() >= 2) fit_.side.high = middle_of(lefts);
  }

  const JointFitOptions& options_;
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

std::optional<JointFit> fit_jointly(const scan::PointCloud& cloud, const StairGraph& graph,
                                    const JointFitOptions& options) {
  return JointFitter(cloud, graph, options).run();
}

}  // namespace stairway::detect
