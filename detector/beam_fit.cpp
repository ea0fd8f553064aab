// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "detector/beam_fit.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "detector/beam_residuals.hpp"
#include "detector/moved_flight.hpp"
#include "detector/robust_descent.hpp"
#include "detector/statistics.hpp"

namespace stairway::detect {
namespace {

// A forgiving kernel first.
constexpr std::array kWideKernels_sigmas{12.0, 9.0};
constexpr std::array kKernels_sigmas{7.0, 5.0};
constexpr std::size_t kFewestBeams = 100;
constexpr double kLittle = 0.3;  // of chi^2: where spots meet edges the cost is rougher than that
constexpr double kReach = 1e-4;  // of derivatives, in units of kFlightScale
constexpr int kMostPasses = 1;   // over uneven steps
constexpr int kFewOf = 4;        // of so many beams one makes the first fit

std::vector<double> finite_ranges(const Eigen::VectorXd& rows) {
  std::vector<double> ranges;
  for (Eigen::Index i = 0; i < rows.size(); i += 2)
    if (std::isfinite(rows[i]) && rows[i] != 0.0) ranges.push_back(rows[i]);
  return ranges;
}

double misfit_of(const Eigen::VectorXd& rows) {
  const std::vector<double> ranges = finite_ranges(rows);
  return ranges.empty() ? std::numeric_limits<double>::max() : robust_deviation(ranges, 0.0);
}

double explained_by(const Eigen::VectorXd& rows) {
  double sum = 0.0;
  for (Eigen::Index i = 0; i < rows.size(); i += 2)
    if (std::isfinite(rows[i])) sum += biweight(std::hypot(rows[i], rows[i + 1]), kKernels_sigmas.back());
  return sum / (0.5 * static_cast<double>(rows.size()));
}

BeamResiduals residuals_at(const StairCorridor& corridor, const BeamFitStart& start, const FlightBase& base,
                           const MovedFlight& flight, const BeamFitOptions& options) {
  const StepFrame frame = base.model.step(base.first);
  const StepPoint sensor = frame.to_step(*corridor.sensor());
  return {base, sensor,
          select_beams(corridor, frame, sensor, visible_faces(flight.shape(base), {sensor.u, sensor.z}), start.sides,
                       0.5 * start.spot_rad, options.edge_beams, options.plane_beams),
          start.range_sigma_m, options.pulse_separation_m};
}

class BeamFitter {
 public:
  BeamFitter(const StairCorridor& corridor, const BeamFitStart& start, bool open_risers, const BeamFitOptions& options)
      : start_(start),
        options_(options),
        base_{.model = start.model, .first = start.first, .open_risers = open_risers, .from_above = start.from_above},
        flight_(unmoved(base_, start.last - start.first + 1, start.offsets, 0.5 * start.spot_rad)),
        usual_(usual_flight(0.5 * start.spot_rad)),
        residuals_(residuals_at(corridor, start, base_, flight_, options)) {
    is_free_.fill(true);
    is_free_[kOverhang] = false;
    is_free_[kThickness] = open_risers;
  }

  /// The model alone.
  std::optional<StairModel> run_roughly() {
    if (residuals_.beams().size() < kFewestBeams) return std::nullopt;
    for (const double kernel : kWideKernels_sigmas) fit_flight(kernel);
    close_in();
    if (!flight_.unknowns.allFinite()) return std::nullopt;
    return flight_.model(base_);
  }

  /// @pre the start is near.
  std::optional<BeamFit> run() {
    if (residuals_.beams().size() < kFewestBeams) return std::nullopt;
    close_in();
    if (!base_.open_risers) look_for_overhang();
    const Eigen::VectorXd rows = residuals_.of(flight_);
    BeamFit fit{.model = flight_.model(base_), .misfit = misfit_of(rows), .explained = explained_by(rows)};
    if (!flight_.unknowns.allFinite() || fit.misfit > options_.max_misfit || fit.explained < options_.min_explained)
      return std::nullopt;
    fit.spot_rad = 2.0 * flight_.unknowns[kSpot];
    fit.shape = flight_.shape(base_);
    for (Eigen::Vector2d& nosing : fit.shape.nosings)
      nosing -= Eigen::Vector2d(flight_.unknowns[kAlong], flight_.unknowns[kUp]);
    const double inflation = std::max(1.0, fit.misfit);
    for (const double kernel : kKernels_sigmas) fit_steps(kernel);
    fit.offsets = offsets(inflation);
    fit.even_sigmas = as_fit_sigmas(inflation * sigmas_);
    fit.sigmas = sigmas_with_uneven_steps(fit.even_sigmas, fit.offsets);
    return fit;
  }

 private:
  void close_in() {
    constexpr int kMostRounds = 12;
    fit_flight(kKernels_sigmas.front());
    for (int round = 0; round < kMostRounds && fit_flight(kKernels_sigmas.back()) > kLittle; ++round) {
    }
  }

  // Far away a lip can hardly be told from a nosing that lies elsewhere: it must explain what is seen clearly better,
  // and more clearly still before its height is asked for.
  void look_for_overhang() {
    constexpr double kUsualOverhang_m = 0.015;
    constexpr double kClearlyBetter = 100.0;  // in chi^2
    constexpr double kShowsLip = 500.0;
    const MovedFlight plain = flight_;
    const FlightUnknowns plain_sigmas = sigmas_;
    const Eigen::VectorXd before = residuals_.of(plain);
    usual_[kOverhang] = kUsualOverhang_m;
    flight_.unknowns[kOverhang] = std::max(start_.model.overhang_m, kUsualOverhang_m);
    flight_.unknowns[kAlong] -= flight_.unknowns[kOverhang];
    is_free_[kOverhang] = true;
    close_in();
    const double gain = robust_gain(residuals_.of(flight_), before, kKernels_sigmas.back());
    if (gain > kShowsLip) {
      is_free_[kThickness] = true;
      close_in();
    } else if (gain < kClearlyBetter) {
      flight_ = plain;
      sigmas_ = plain_sigmas;
    }
  }

  // Steps of Gauss and Newton, each as far towards its solution as the robust cost falls, which share the derivatives
  // of the first as long as they get on. Returns by how much it fell.
  double fit_flight(double kernel_sigmas) {
    constexpr int kMostSteps = 4;
    Eigen::VectorXd r = residuals_.of(flight_);
    const Eigen::MatrixXd J = residuals_.derived(flight_, r, is_free_, kReach);
    double sum = 0.0;
    double gain = std::numeric_limits<double>::infinity();
    for (int step = 0; step < kMostSteps && gain > kLittle; ++step)
      sum += gain = step_towards_beams(r, J, kernel_sigmas);
    return sum;
  }

  // Moves the flight, and the rows `r` with it. Returns by how much the robust cost falls.
  double step_towards_beams(Eigen::VectorXd& r, const Eigen::MatrixXd& J, double kernel_sigmas) {
    NormalEquations normal{Eigen::MatrixXd::Zero(kFlightUnknowns, kFlightUnknowns),
                           Eigen::VectorXd::Zero(kFlightUnknowns)};
    for (std::size_t i = 0; i < kFlightUnknowns; ++i) {
      const auto k = static_cast<Eigen::Index>(i);
      const double prior = kFlightScale[i] / kFlightPrior[i];
      normal.information(k, k) = prior * prior;
      normal.gradient[k] = (flight_.unknowns[k] - usual_[k]) / kFlightScale[i] * normal.information(k, k);
    }
    add_rows(r, J, kernel_sigmas, kReach, normal);
    const Eigen::Map<const FlightUnknowns> scale(kFlightScale.data());
    double gain = 0.0;
    damped_descent(normal, [&](const Eigen::VectorXd& change) {
      const MovedFlight next = flight_.changed(scale.cwiseProduct(FlightUnknowns(change)));
      Eigen::VectorXd next_r = residuals_.of(next);
      gain = std::max(0.0, robust_gain(next_r, r, kernel_sigmas));
      if (gain == 0.0) return false;
      flight_ = next;
      r = std::move(next_r);
      return true;
    });
    sigmas_ = scale.cwiseProduct(FlightUnknowns(normal.sigmas()));
    return gain;
  }

  // Every step on its own, the flight as a whole held.
  void fit_steps(double kernel_sigmas) {
    constexpr double kReach_m = 1e-4;
    constexpr double kPrior = 1.0 / (kSurelyUneven_m * kSurelyUneven_m);
    const Eigen::Index steps = flight_.ahead.size();
    NormalEquations normal{kPrior * Eigen::MatrixXd::Identity(2 * steps, 2 * steps), Eigen::VectorXd(2 * steps)};
    normal.gradient << kPrior * flight_.ahead, kPrior * flight_.up;
    const Eigen::VectorXd r = residuals_.of(flight_);
    add_rows(r, residuals_.derived_by_steps(flight_, kReach_m), kernel_sigmas, 2.0 * kReach_m, normal);
    damped_descent(normal, [&](const Eigen::VectorXd& change) {
      MovedFlight next = flight_;
      next.ahead += change.head(steps);
      next.up += change.tail(steps);
      if (robust_gain(residuals_.of(next), r, kernel_sigmas) < 0.0) return false;
      flight_ = next;
      return true;
    });
    step_sigmas_ = normal.sigmas();
  }

  static FitSigmas as_fit_sigmas(const FlightUnknowns& sigmas) {
    return {.height_m = sigmas[kRise], .depth_m = sigmas[kDepth], .heading_rad = sigmas[kHeading]};
  }

  // Steps lie where they do not only by chance of the beams: what their offsets scatter by beyond that counts once for
  // every step, however many beams it shows.
  FitSigmas sigmas_with_uneven_steps(const FitSigmas& even, const std::vector<StepOffset>& offsets) const {
    const double up_m = unevenness(offsets, &StepOffset::up);
    const double ahead_m = unevenness(offsets, &StepOffset::ahead);
    const auto n = static_cast<double>(offsets.size());
    const double slope = std::sqrt(12.0 / std::max(6.0, n * (n * n - 1.0)));  // of a line through n evenly spaced
    const double across = std::sqrt(12.0 / n) / start_.sides.length();
    return {.height_m = std::hypot(even.height_m, slope * up_m),
            .depth_m = std::hypot(even.depth_m, slope * ahead_m),
            .heading_rad = std::hypot(even.heading_rad, across * ahead_m)};
  }

  // What the place of an edge in the spot may be off by from step to step.
  double uneven_floor_m() const {
    constexpr double kSpotShare = 0.03;
    return kSpotShare * usual_[kSpot] * residuals_.sensor_distance_m();
  }

  double unevenness(const std::vector<StepOffset>& offsets, std::optional<Estimate> StepOffset::*part) const {
    double excess = 0.0;
    double count = 0.0;
    for (const StepOffset& offset : offsets) {
      const std::optional<Estimate>& off = offset.*part;
      if (!off) continue;
      excess += std::min(off->value * off->value, kSurelyUneven_m * kSurelyUneven_m) - off->sigma * off->sigma;
      count += 1.0;
    }
    return std::hypot(uneven_floor_m(), std::sqrt(std::max(0.0, excess / std::max(1.0, count))));
  }

  std::vector<StepOffset> offsets(double inflation) const {
    constexpr double kUnseen = 0.5;  // of what is known beforehand
    const Eigen::Index steps = flight_.ahead.size();
    const auto estimate = [&](double value, double sigma) {
      return sigma < kUnseen * kSurelyUneven_m
                 ? std::optional(Estimate{value, std::hypot(inflation * sigma, uneven_floor_m())})
                 : std::nullopt;
    };
    std::vector<StepOffset> result;
    for (Eigen::Index i = 0; i < steps; ++i)
      result.push_back({.number = start_.first + static_cast<int>(i),
                        .up = estimate(flight_.up[i], step_sigmas_[steps + i]),
                        .ahead = estimate(flight_.ahead[i], step_sigmas_[i])});
    return result;
  }

  const BeamFitStart& start_;
  const BeamFitOptions& options_;
  const FlightBase base_;
  MovedFlight flight_;
  FlightUnknowns usual_;
  std::array<bool, kFlightUnknowns> is_free_{};
  BeamResiduals residuals_;
  FlightUnknowns sigmas_ = FlightUnknowns::Zero();
  Eigen::VectorXd step_sigmas_;
};

}  // namespace

namespace {

std::ptrdiff_t measured_steps(const BeamFit& fit) {
  return std::count_if(fit.offsets.begin(), fit.offsets.end(),
                       [](const StepOffset& offset) { return offset.up.has_value(); });
}

// More beams explained, or as many more exactly; a fit beside the steps explains the few beams that it takes for
// theirs.
bool is_clearly_better(const BeamFit& fit, const BeamFit& other) {
  constexpr double kClearly = 1.04;
  constexpr std::ptrdiff_t kManyTimes = 2;
  return fit.explained / fit.misfit > kClearly * other.explained / other.misfit ||
         measured_steps(fit) > kManyTimes * measured_steps(other);
}

}  // namespace

std::string BeamFitOptions::problem() const {
  if (!(pulse_separation_m > 0.0)) return "pulse_separation_m must be greater than 0";
  if (edge_beams < 1 || plane_beams < 1) return "edge_beams and plane_beams must be at least 1";
  if (!(max_misfit > 0.0)) return "max_misfit must be greater than 0";
  return {};
}

std::optional<BeamFit> fit_beams(const StairCorridor& corridor, const BeamFitStart& start,
                                 const BeamFitOptions& options) {
  if (!corridor.sensor() || start.model.is_spiral() || start.last < start.first) return std::nullopt;
  // A few beams first, for which beams see which edge is told by where the flight is taken to be.
  BeamFitOptions few = options;
  few.edge_beams = std::max(1, options.edge_beams / kFewOf);
  few.plane_beams = std::max(1, options.plane_beams / kFewOf);
  const auto fit_as = [&](bool open_risers, bool is_regular) {
    BeamFitStart as = start;
    if (is_regular) as.offsets.clear();
    if (const std::optional<StairModel> nearer = BeamFitter(corridor, as, open_risers, few).run_roughly())
      as.model = *nearer;
    std::optional<BeamFit> fit = BeamFitter(corridor, as, open_risers, options).run();
    // Which beams see an uneven step is told by where that step lies.
    for (int pass = 0; pass < kMostPasses && fit && are_irregular(fit->offsets); ++pass) {
      as.model = fit->model;
      as.offsets = fit->offsets;
      if (std::optional<BeamFit> again = BeamFitter(corridor, as, open_risers, options).run()) fit = std::move(again);
    }
    return fit;
  };
  // What explains more beams is true; what is unusual must explain them clearly better. Risers are tried first: taken
  // for a backdrop behind open ones they would explain nearly as much.
  constexpr double kWell = 0.75;
  const auto explained = [](const std::optional<BeamFit>& fit) { return fit ? fit->explained : 0.0; };
  bool open_risers = false;
  std::optional<BeamFit> best = fit_as(false, true);
  if (explained(best) < kWell) {
    std::optional<BeamFit> open = fit_as(true, true);
    open_risers = explained(open) > explained(best);
    if (open_risers) best = std::move(open);
  }
  if (start.offsets.empty()) return best;
  std::optional<BeamFit> irregular = fit_as(open_risers, false);
  return irregular && (!best || is_clearly_better(*irregular, *best)) ? irregular : best;
}

}  // namespace stairway::detect
