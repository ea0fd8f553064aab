// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "detector/joint_fit.hpp"

#include <algorithm>
#include <cmath>

#include "detector/beam_fit.hpp"
#include "detector/flight_ends.hpp"
#include "detector/moved_flight.hpp"
#include "detector/statistics.hpp"
#include "detector/step_ends.hpp"
#include "detector/step_fit.hpp"

namespace stairway::detect {
namespace {

constexpr int kMostSteps = 200;  // bounds the search beyond the ends
constexpr double kNarrowest_m = 0.1;
constexpr double kUnmeasuredEnd_m = 0.03;   // an end known from the parts alone
constexpr double kUncheckedSides_m = 0.08;  // a width that no beams confirm

// The few steps in a row that most parts speak for.
std::pair<int, int> best_supported(const StairGraph& graph) {
  constexpr int kInARow = 5;
  std::pair<int, int> best{graph.parts.front().step, graph.parts.front().step};
  std::ptrdiff_t most = 0;
  for (auto begin = graph.parts.begin(); begin != graph.parts.end(); ++begin) {
    const auto end = std::find_if(begin, graph.parts.end(),
                                  [&](const GraphPart& part) { return part.step >= begin->step + kInARow; });
    if (end - begin <= most) continue;
    most = end - begin;
    best = {begin->step, std::prev(end)->step};
  }
  return best;
}

class JointFitter {
 public:
  JointFitter(const scan::PointCloud& cloud, const StairGraph& graph, const Interval& sides, View view,
              const JointFitOptions& options)
      : options_(options), prior_(graph.model), view_(view), corridor_(cloud, graph.model, sides) {
    fit_.model = graph.model;
    fit_.sides = sides;
    const auto [first, last] = best_supported(graph);
    fit_.first = first;
    fit_.last = last;
  }

  std::optional<JointFit> run() {
    bool is_last = false;
    for (int pass = 0; !is_last; ++pass) {
      const JointFit before = fit_;
      if (!measure(pass == 0 ? 0 : fit_.last - fit_.first + 1)) return std::nullopt;
      fit_steps();
      is_last = pass + 1 == options_.passes || (pass > 0 && has_settled_since(before));
      if (is_last) fit_.offsets = offsets();
      if (!fit_sides()) return std::nullopt;
    }
    refine_by_beams();
    return fit_;
  }

 private:
  bool beams_follow() const { return !fit_.model.is_spiral() && corridor_.sensor(); }

  // Beams only need a start that tells which of them meet which edge.
  bool has_settled_since(const JointFit& before) const {
    const double far_m = beams_follow() ? 0.5e-3 : 0.02e-3;
    const auto has_moved = [&](int number) {
      return (fit_.model.step(number).nosing - before.model.step(number).nosing).norm() > far_m;
    };
    return before.first == fit_.first && before.last == fit_.last && !has_moved(fit_.first) && !has_moved(fit_.last);
  }

  std::optional<StepMeasurement> seen(int number) const {
    if (!may_be_step(number)) return std::nullopt;
    StepMeasurement step = measure_step(corridor_, fit_.model, fit_.sides, number, options_.measurement);
    if (!step.seen() || (is_ground(number) && !step.nosing)) return std::nullopt;
    return step;
  }

  // The floor the robot stands on looks like a tread at z = 0. Its edge is the last nosing of a descent; else it is no
  // step.
  bool is_ground(int number) const { return std::abs(fit_.model.step(number).nosing.z()) < 0.5 * fit_.model.height_m; }
  bool may_be_step(int number) const {
    if (view_ == View::FromBelow) return !is_ground(number);
    return fit_.model.step(number).nosing.z() < 0.5 * fit_.model.height_m;
  }

  // Measures the known steps and looks for up to `reach` more beyond both ends. As many as are fitted already tell well
  // enough where those are; a model off by a fifteenth of a step would meet one step too few in all of a long flight.
  bool measure(int reach) {
    steps_.clear();
    const auto look_at = [&](int number) {
      std::optional<StepMeasurement> step = seen(number);
      if (step) steps_.push_back(std::move(*step));
      return step.has_value();
    };
    for (int number = fit_.first; number <= fit_.last; ++number) look_at(number);
    for (const int direction : {+1, -1}) {
      const int end = direction > 0 ? fit_.last : fit_.first;
      int unseen = 0;
      for (int i = 1; i <= reach && unseen < options_.max_unseen_steps; ++i) {
        const int number = end + i * direction;
        if (!may_be_step(number) || std::abs(number) > kMostSteps) break;
        unseen = look_at(number) ? 0 : unseen + 1;
      }
    }
    std::sort(steps_.begin(), steps_.end(),
              [](const StepMeasurement& a, const StepMeasurement& b) { return a.number < b.number; });
    keep_longest_run();
    leave_lower_floor();
    leave_landing();
    if (steps_.size() < 2) return false;
    fit_.first = steps_.front().number;
    fit_.last = steps_.back().number;
    fit_.seen_steps = static_cast<int>(steps_.size());
    fit_.measurements = 0;
    for (const StepMeasurement& step : steps_) fit_.measurements += step.count();
    return true;
  }

  // A flight may begin on a landing, which looks like a tread, as may the ceiling below it.
  void leave_landing() {
    fit_.on_landing = false;
    if (view_ == View::FromAbove) return;
    const auto half = static_cast<std::ptrdiff_t>(steps_.size() / 2);
    const auto landing = std::find_if(std::make_reverse_iterator(steps_.begin() + half), steps_.rend(),
                                      [](const StepMeasurement& step) { return step.is_landing; });
    fit_.on_landing = landing != steps_.rend();
    steps_.erase(steps_.begin(), landing.base());
  }

  // Below a descent the floor goes on where the next tread would be; unlike a tread it has no edge.
  void leave_lower_floor() {
    if (view_ == View::FromBelow) return;
    const auto has_edge = [](const StepMeasurement& step) { return step.front || step.nosing; };
    steps_.erase(steps_.begin(), std::find_if(steps_.begin(), steps_.end(), has_edge));
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

  bool has_risers() const {
    const auto fronts =
        std::count_if(steps_.begin(), steps_.end(), [](const StepMeasurement& step) { return step.front.has_value(); });
    const auto risers =
        std::count_if(steps_.begin(), steps_.end(), [](const StepMeasurement& step) { return step.has_riser; });
    return 2 * risers > fronts;
  }

  void fit_steps() {
    const StepFit fit = fit_to_steps(fit_.model, prior_, has_risers(), steps_);
    fit_.model = fit.model;
    fit_.sigmas = fit_.even_sigmas = fit.sigmas;
    biases_ = fit.biases;
  }

  void refine_by_beams() {
    if (!beams_follow()) return;
    const BeamFitStart start{.model = fit_.model,
                             .sides = fit_.sides,
                             .first = fit_.first,
                             .last = fit_.last,
                             .offsets = are_irregular(fit_.offsets) ? fit_.offsets : std::vector<StepOffset>{},
                             .range_sigma_m = options_.measurement.range_sigma_m,
                             .spot_rad = options_.measurement.spot_rad,
                             .from_above = view_ == View::FromAbove};
    const std::optional<BeamFit> beams = fit_beams(corridor_, start, options_.beams);
    if (!beams) {
      // Of few points too few beams are left to say anything, and boards are easily seen past.
      constexpr std::size_t kEnough = 20000;
      fit_.is_contradicted = has_risers() && corridor_.points().size() > kEnough;
      keep_to_steps();
      fit_.sides_sigma_m = std::hypot(fit_.sides_sigma_m, kUncheckedSides_m);
      return;
    }
    constexpr double kHardlyExplained = 0.4;
    const bool explains_little = beams->explained < kHardlyExplained;
    if (explains_little && !has_risers()) {
      // Through an open flight, past balusters, most beams meet other things; what few are left may lead astray.
      keep_to_steps();
      find_ends(start, as_measured(start));
    } else {
      // Few beams may be left to explain; those must then lie the better.
      constexpr double kPoor = 1.25;
      fit_.is_contradicted = explains_little && beams->misfit > kPoor;
      take_over(*beams);
      find_ends(start, beams->shape);
    }
  }

  // Where no beams confirm them, edges may be off by a share of the spot, and single steps by more than steps are.
  void keep_to_steps() {
    constexpr double kSpotShare = 0.06;
    const double distance_m = (fit_.model.step(fit_.first).nosing - *corridor_.sensor()).norm();
    const double off_m = kSpotShare * options_.measurement.spot_rad * distance_m;
    fit_.offsets.clear();
    fit_.sigmas.height_m = std::hypot(fit_.sigmas.height_m, off_m);
    fit_.sigmas.depth_m = std::hypot(fit_.sigmas.depth_m, off_m);
    fit_.sigmas.heading_rad = std::hypot(fit_.sigmas.heading_rad, 2.0 * off_m / fit_.sides.length());
    fit_.even_sigmas = fit_.sigmas;
  }

  static StairProfileShape as_measured(const BeamFitStart& start) {
    const FlightBase base{
        .model = start.model, .first = start.first, .open_risers = true, .from_above = start.from_above};
    return unmoved(base, start.last - start.first + 1, {}, 0.5 * start.spot_rad).shape(base);
  }

  void take_over(const BeamFit& beams) {
    constexpr double kMostExplained = 0.6;
    fit_.model = beams.model;
    fit_.sigmas = beams.sigmas;
    fit_.even_sigmas = beams.even_sigmas;
    fit_.offsets = beams.offsets;
    if (beams.explained < kMostExplained && !are_irregular(fit_.offsets, true)) fit_.offsets.clear();
    measure(0);
  }

  void find_ends(const BeamFitStart& start, const StairProfileShape& shape) {
    const StepFrame frame = fit_.model.step(start.first);
    const StepPoint sensor = frame.to_step(*corridor_.sensor());
    flight_ends_ = find_flight_ends(corridor_, frame, sensor, visible_faces(shape, {sensor.u, sensor.z}), fit_.sides,
                                    {0.5 * start.spot_rad, options_.beams.pulse_separation_m}, start.range_sigma_m,
                                    start.from_above ? start.last - start.first : -1);
    fit_sides();
  }

  // What an irregular stairway has told about biases was its irregularity.
  std::vector<StepOffset> offsets() const {
    std::vector<StepOffset> offsets = step_offsets(fit_.model, biases_, steps_);
    return are_irregular(offsets) ? step_offsets(fit_.model, {}, steps_) : offsets;
  }

  // Also puts the middle line into the middle of the sides.
  bool fit_sides() {
    std::vector<Estimate> rights;
    std::vector<Estimate> lefts;
    std::vector<double> right_limits;
    std::vector<double> left_limits;
    for (const StepMeasurement& step : steps_) {
      if (is_ground(step.number)) continue;  // it goes on beside a descent
      if (step.right_end) rights.push_back(*step.right_end);
      if (step.left_end) lefts.push_back(*step.left_end);
      if (step.right_limit) right_limits.push_back(*step.right_limit);
      if (step.left_limit) left_limits.push_back(*step.left_limit);
    }
    const std::optional<Estimate> right = flight_ends_.right ? flight_ends_.right : common_end(rights, -1.0);
    const std::optional<Estimate> left = flight_ends_.left ? flight_ends_.left : common_end(lefts, +1.0);
    if (right) fit_.sides.low = right->value;
    if (left) fit_.sides.high = left->value;
    fit_.sides_sigma_m = std::hypot(right ? right->sigma : kUnmeasuredEnd_m, left ? left->sigma : kUnmeasuredEnd_m);
    if (!(fit_.sides.length() > kNarrowest_m)) return false;
    const double middle = fit_.sides.middle();
    fit_.right_limit.reset();
    fit_.left_limit.reset();
    if (!flight_ends_.right && !right_limits.empty()) fit_.right_limit = outer_quartile(right_limits, true) - middle;
    if (!flight_ends_.left && !left_limits.empty()) fit_.left_limit = outer_quartile(left_limits, false) - middle;
    fit_.model = fit_.model.moved_aside(middle);
    prior_ = prior_.moved_aside(fit_.sides.middle());
    const double half = 0.5 * fit_.sides.length();
    fit_.sides = {-half, half};
    return fit_.model.depth_m > 0.0 && fit_.model.height_m > 0.0;
  }

  const JointFitOptions& options_;
  StairModel prior_;  // of the graph
  const View view_;
  StairCorridor corridor_;
  JointFit fit_;
  std::vector<StepMeasurement> steps_;
  CommonBiases biases_;
  FlightEnds flight_ends_;
};

}  // namespace

std::string JointFitOptions::problem() const {
  if (passes < 1) return "passes must be at least 1";
  if (max_unseen_steps < 1) return "max_unseen_steps must be at least 1";
  if (std::string problem = beams.problem(); !problem.empty()) return problem;
  return measurement.problem();
}

std::optional<JointFit> fit_jointly(const scan::PointCloud& cloud, const StairGraph& graph, const Interval& sides,
                                    View view, const JointFitOptions& options) {
  if (graph.parts.empty() || !(sides.length() > kNarrowest_m)) return std::nullopt;
  return JointFitter(cloud, graph, sides, view, options).run();
}

namespace {

// As near to the limits as three sigmas allow: a step as deep as the deepest may well be measured a little deeper.
StairModel nearest_to(const StepLimits& limits, const JointFit& fit) {
  constexpr double kSigmas = 3.0;
  const auto towards = [](double value, double low, double high, double reach) {
    return std::clamp(std::clamp(value, low, high), value - reach, value + reach);
  };
  StairModel model = fit.model;
  model.height_m = towards(model.height_m, limits.min_height_m, limits.max_height_m, kSigmas * fit.sigmas.height_m);
  model.depth_m = towards(model.depth_m, limits.min_depth_m, limits.max_depth_m, kSigmas * fit.sigmas.depth_m);
  return model;
}

}  // namespace

std::string broken_rule(const JointFit& fit, const StepLimits& limits, const ConfirmationOptions& confirmation,
                        const JointFitOptions& options) {
  if (std::string rule = broken_rule(fit.model, fit.seen_steps, confirmation); !rule.empty()) return rule;
  if (!limits.allow(nearest_to(limits, fit))) return "step-size-out-of-range";
  if (fit.seen_steps < options.min_seen_share * (fit.last - fit.first + 1)) return "steps-missing";
  // Of uneven steps each is told by itself.
  const FitSigmas& sigmas = are_irregular(fit.offsets) ? fit.even_sigmas : fit.sigmas;
  if (std::max(sigmas.height_m, sigmas.depth_m) > options.max_sigma_m) return "too-uncertain";
  if (fit.is_contradicted) return "beams-disagree";
  return {};
}

}  // namespace stairway::detect
