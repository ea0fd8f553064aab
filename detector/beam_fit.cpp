// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "detector/beam_fit.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "detector/statistics.hpp"

namespace stairway::detect {
namespace {

enum Unknown { kAlong, kUp, kDepth, kRise, kHeading, kOverhang, kThickness, kSpot, kUnknowns };
using Unknowns = Eigen::Matrix<double, kUnknowns, 1>;

// What is known of each beforehand: how far it may be from where the fit starts.
constexpr std::array<double, kUnknowns> kPrior{0.05, 0.05, 0.02, 0.02, 0.05, 0.010, 0.02, 0.5e-3};
// Of what size changes are to be compared: metres, but angles seen over some metres.
constexpr std::array<double, kUnknowns> kScale{1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 0.2};
constexpr double kUsualThickness_m = 0.04;
constexpr double kMostOverhang_m = 0.06;
constexpr double kLeastThickness_m = 0.015;
constexpr double kMostThickness_m = 0.08;
constexpr double kLeastRadius_rad = 0.5e-3;
constexpr double kSurelyUneven_m = 0.03;  // what a step may be off by

/// A flight as the fit moves it: in the axes of the lowest step where the fit began.
struct Flight {
  Unknowns unknowns = Unknowns::Zero();  ///< changes, but overhang, thickness and spot as they are
  Eigen::VectorXd ahead;                 ///< offsets of single steps [m]
  Eigen::VectorXd up;                    ///< likewise
};

// A forgiving kernel first.
constexpr std::array kKernels_sigmas{12.0, 9.0, 7.0, 5.0};

// Tukey's biweight.
double weight_of(double residual, double kernel_sigmas) {
  const double x = residual / kernel_sigmas;
  return std::abs(x) >= 1.0 ? 0.0 : (1.0 - x * x) * (1.0 - x * x);
}

// By how much the robust chi^2 falls. Rows of which nobody can tell what they should be, before or after, do not count.
double gain_of(const Eigen::VectorXd& after, const Eigen::VectorXd& before, double kernel_sigmas) {
  const auto cost = [&](double r) {
    const double x = r / kernel_sigmas;
    return std::abs(x) < 1.0 ? 1.0 - std::pow(1.0 - x * x, 3) : 1.0;
  };
  double gain = 0.0;
  for (Eigen::Index i = 0; i < before.size(); ++i)
    if (std::isfinite(before[i]) && std::isfinite(after[i])) gain += cost(before[i]) - cost(after[i]);
  return gain * kernel_sigmas * kernel_sigmas / 3.0;
}

/// What a beam differs by from what it should have measured, in sigmas; NaN where nobody can tell that.
struct BeamResidual {
  double range = std::numeric_limits<double>::quiet_NaN();
  double share = 0.0;  ///< of the spot on the surface that answered
};

class BeamFitter {
 public:
  BeamFitter(const StairCorridor& corridor, const BeamFitStart& start, bool open_risers, const BeamFitOptions& options)
      : start_(start), open_risers_(open_risers), options_(options), frame_(start.model.step(start.first)) {
    sensor_ = frame_.to_step(*corridor.sensor());
    const auto steps = static_cast<Eigen::Index>(start.last - start.first + 1);
    flight_.ahead = flight_.up = Eigen::VectorXd::Zero(steps);
    for (const StepOffset& offset : start.offsets) {
      const Eigen::Index i = offset.number - start.first;
      if (i < 0 || i >= steps) continue;
      if (offset.ahead) flight_.ahead[i] = std::clamp(offset.ahead->value, -kSurelyUneven_m, kSurelyUneven_m);
      if (offset.up) flight_.up[i] = std::clamp(offset.up->value, -kSurelyUneven_m, kSurelyUneven_m);
    }
    flight_.unknowns[kThickness] = open_risers && start.model.tread_thickness_m > kLeastThickness_m
                                       ? start.model.tread_thickness_m
                                       : kUsualThickness_m;
    flight_.unknowns[kSpot] = 0.5 * start.spot_rad;
    is_free_.fill(true);
    is_free_[kOverhang] = false;
    is_free_[kThickness] = open_risers;
    usual_ = flight_.unknowns;
    usual_[kOverhang] = 0.0;
    usual_[kThickness] = kUsualThickness_m;
    beams_ = select_beams(corridor, frame_, sensor_, visible_faces(shape(flight_), {sensor_.u, sensor_.z}), start.sides,
                          0.5 * start.spot_rad, options.edge_beams, options.plane_beams);
  }

  std::optional<BeamFit> run() {
    constexpr std::size_t kFewestBeams = 100;
    if (beams_.size() < kFewestBeams) return std::nullopt;
    close_in();
    if (!open_risers_) look_for_overhang();
    BeamFit fit{.model = model()};
    fit.misfit = robust_deviation(residuals_of_known(), 0.0);
    fit.explained = explained();
    if (!flight_.unknowns.allFinite() || fit.misfit > options_.max_misfit || fit.explained < options_.min_explained)
      return std::nullopt;
    fit.spot_rad = 2.0 * flight_.unknowns[kSpot];
    const Unknowns sigmas = std::max(1.0, fit.misfit) * sigmas_;
    fit.shape = shape(flight_);
    for (Eigen::Vector2d& nosing : fit.shape.nosings)
      nosing -= Eigen::Vector2d(flight_.unknowns[kAlong], flight_.unknowns[kUp]);
    for (const double kernel : kKernels_sigmas) fit_steps(kernel);
    fit.offsets = offsets(std::max(1.0, fit.misfit));
    fit.sigmas = sigmas_with_uneven_steps(sigmas, fit.offsets);
    return fit;
  }

 private:
  void close_in() {
    constexpr int kMostRounds = 12;
    constexpr double kSettled = 0.05;  // sigmas
    for (const double kernel : kKernels_sigmas) fit_flight(kernel);
    for (int round = 0; round < kMostRounds && fit_flight(kKernels_sigmas.back()) > kSettled; ++round) {
    }
  }

  // Far away a lip can hardly be told from a nosing that lies elsewhere: it must explain what is seen clearly better,
  // and more clearly still before its height is asked for.
  void look_for_overhang() {
    constexpr double kUsualOverhang_m = 0.015;
    constexpr double kClearlyBetter = 100.0;  // in chi^2
    constexpr double kShowsLip = 500.0;
    const Flight plain = flight_;
    const Unknowns plain_sigmas = sigmas_;
    const Eigen::VectorXd before = residuals(plain);
    usual_[kOverhang] = kUsualOverhang_m;
    flight_.unknowns[kOverhang] = std::max(start_.model.overhang_m, kUsualOverhang_m);
    flight_.unknowns[kAlong] -= flight_.unknowns[kOverhang];
    is_free_[kOverhang] = true;
    close_in();
    const double gain = gain_of(residuals(flight_), before, kKernels_sigmas.back());
    if (gain > kShowsLip) {
      is_free_[kThickness] = true;
      close_in();
    } else if (gain < kClearlyBetter) {
      flight_ = plain;
      sigmas_ = plain_sigmas;
    }
  }

  StairProfileShape shape(const Flight& flight) const {
    constexpr double kFloor_m = 100.0;
    StairProfileShape shape{.overhang_m = flight.unknowns[kOverhang],
                            .thickness_m = flight.unknowns[kThickness],
                            .open_risers = open_risers_,
                            .step_height_m = 0.5 * start_.model.height_m,
                            .last_tread_m = start_.from_above ? kFloor_m : 0.0,
                            .goes_on_below = start_.from_above};
    for (Eigen::Index i = 0; i < flight.ahead.size(); ++i) {
      const auto number = static_cast<double>(i);
      shape.nosings.emplace_back(
          flight.unknowns[kAlong] + number * (start_.model.depth_m + flight.unknowns[kDepth]) + flight.ahead[i],
          flight.unknowns[kUp] + number * (start_.model.height_m + flight.unknowns[kRise]) + flight.up[i]);
    }
    return shape;
  }

  /// The profile a flight shows to the sensor, ready to be asked by beams.
  struct Look {
    std::vector<VisibleFace> faces;
    double cosine = 1.0;
    double sine = 0.0;
    double radius_rad = 0.0;
  };

  Look look(const Flight& flight) const {
    Look look{.cosine = std::cos(flight.unknowns[kHeading]), .sine = std::sin(flight.unknowns[kHeading])};
    look.faces = visible_faces(shape(flight), {sensor_.u * look.cosine + sensor_.v * look.sine, sensor_.z});
    look.radius_rad = flight.unknowns[kSpot];
    return look;
  }

  BeamResidual residual(const StairBeam& beam, const Look& look) const {
    constexpr double kUnevenSpot = 0.05;  // what a share of the spot may be off by, for its light is not quite even
    constexpr double kShareSigma = 0.3;   // of the share, where the larger of two surfaces answers alone
    constexpr double kAnyOther_m = 0.10;  // an echo farther from both was something else's
    const double u = beam.u * look.cosine + beam.v * look.sine;
    const double plane_m = std::hypot(u, beam.z);
    const double range_m = std::sqrt(beam.u * beam.u + beam.v * beam.v + beam.z * beam.z);
    const double scale = range_m / plane_m;
    const SpotEcho echo = echo_of(look.faces, std::atan2(beam.z, u), look.radius_rad * scale, beam.backdrop,
                                  options_.pulse_separation_m / scale);
    if (!echo.is_known) return {};
    const auto over_sigma = [&](double off_m) {
      return off_m * scale / std::hypot(start_.range_sigma_m, kUnevenSpot * echo.spread_m * scale);
    };
    // What lies past the flight is not what is fitted.
    if (echo.is_past) return {.range = 0.0, .share = plane_m < echo.range_m - kAnyOther_m ? 1.0 / kShareSigma : 0.0};
    if (!echo.is_split) return {.range = over_sigma(plane_m - echo.range_m)};
    const bool is_near = std::abs(plane_m - echo.near_m) < std::abs(plane_m - echo.far_m);
    if (std::abs(plane_m - (is_near ? echo.near_m : echo.far_m)) > kAnyOther_m) return {};
    return {.range = is_near ? over_sigma(plane_m - echo.near_m) : 0.0,
            .share = ((is_near ? 1.0 : 0.0) - echo.near_share) / kShareSigma};
  }

  // Two rows a beam.
  void put_residual(std::size_t i, const Look& look, Eigen::Ref<Eigen::VectorXd> rows) const {
    const BeamResidual r = residual(beams_[i], look);
    rows[2 * static_cast<Eigen::Index>(i)] = r.range;
    rows[2 * static_cast<Eigen::Index>(i) + 1] = r.share;
  }

  Eigen::VectorXd residuals(const Flight& flight) const {
    const Look view = look(flight);
    Eigen::VectorXd rows(2 * static_cast<Eigen::Index>(beams_.size()));
    for (std::size_t i = 0; i < beams_.size(); ++i) put_residual(i, view, rows);
    return rows;
  }

  double explained() const {
    const Eigen::VectorXd all = residuals(flight_);
    double sum = 0.0;
    for (Eigen::Index i = 0; i < all.size(); i += 2)
      if (std::isfinite(all[i])) sum += weight_of(std::hypot(all[i], all[i + 1]), kKernels_sigmas.back());
    return sum / static_cast<double>(beams_.size());
  }

  // Steps lie where they do not only by chance of the beams: what their offsets scatter by beyond that counts once for
  // every step, however many beams it shows.
  FitSigmas sigmas_with_uneven_steps(const Unknowns& sigmas, const std::vector<StepOffset>& offsets) const {
    const double up_m = unevenness(offsets, &StepOffset::up);
    const double ahead_m = unevenness(offsets, &StepOffset::ahead);
    const auto n = static_cast<double>(offsets.size());
    const double slope = std::sqrt(12.0 / std::max(6.0, n * (n * n - 1.0)));  // of a line through n evenly spaced
    const double across = std::sqrt(12.0 / n) / start_.sides.length();
    return {.height_m = std::hypot(sigmas[kRise], slope * up_m),
            .depth_m = std::hypot(sigmas[kDepth], slope * ahead_m),
            .heading_rad = std::hypot(sigmas[kHeading], across * ahead_m)};
  }

  // What the place of an edge in the spot may be off by from step to step.
  double uneven_floor_m() const {
    constexpr double kSpotShare = 0.02;
    return kSpotShare * usual_[kSpot] * std::hypot(sensor_.u, sensor_.v, sensor_.z);
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

  std::vector<double> residuals_of_known() const {
    const Eigen::VectorXd all = residuals(flight_);
    std::vector<double> known;
    for (Eigen::Index i = 0; i < all.size(); i += 2)
      if (std::isfinite(all[i]) && all[i] != 0.0) known.push_back(all[i]);
    return known.empty() ? std::vector<double>{std::numeric_limits<double>::max()} : known;
  }

  Flight changed(const Unknowns& by) const {
    Flight flight = flight_;
    flight.unknowns += by;
    flight.unknowns[kOverhang] = std::clamp(flight.unknowns[kOverhang], 0.0, kMostOverhang_m);
    flight.unknowns[kThickness] = std::clamp(flight.unknowns[kThickness], kLeastThickness_m, kMostThickness_m);
    flight.unknowns[kSpot] = std::max(flight.unknowns[kSpot], kLeastRadius_rad);
    return flight;
  }

  /// The normal equations of a round.
  struct Normal {
    Eigen::MatrixXd information;
    Eigen::VectorXd gradient;
  };

  // Levenberg and Marquardt: ever shorter and steeper steps until one is `taken`.
  template <typename Taken>
  static void damped_descent(const Normal& normal, const Taken& taken) {
    for (const double damping : {0.0, 0.03, 0.3, 3.0, 30.0}) {
      Eigen::MatrixXd damped = normal.information;
      damped.diagonal() *= 1.0 + damping;
      if (taken(-damped.ldlt().solve(normal.gradient))) return;
    }
  }

  // A row that jumps where it is derived says nothing about what lies beyond the jump.
  static void add_rows(const Eigen::VectorXd& r, const Eigen::MatrixXd& J, double kernel_sigmas, double small,
                       Normal& normal) {
    constexpr double kJump = 3.0;
    for (Eigen::Index i = 0; i < r.size(); ++i) {
      if (!std::isfinite(r[i]) || !J.row(i).allFinite() || J.row(i).cwiseAbs().maxCoeff() * small > kJump) continue;
      const double weight = weight_of(r[i], kernel_sigmas);
      normal.information.selfadjointView<Eigen::Lower>().rankUpdate(J.row(i).transpose(), weight);
      normal.gradient += weight * r[i] * J.row(i).transpose();
    }
    normal.information = normal.information.selfadjointView<Eigen::Lower>();
  }

  // One step of Gauss and Newton, as far towards its solution as the robust cost falls. Returns how far, in sigmas.
  double fit_flight(double kernel_sigmas) {
    constexpr double kSmall = 1e-4;
    const Eigen::VectorXd r = residuals(flight_);
    Eigen::MatrixXd J(r.size(), static_cast<Eigen::Index>(kUnknowns));
    Normal normal{Eigen::MatrixXd::Zero(kUnknowns, kUnknowns), Eigen::VectorXd::Zero(kUnknowns)};
    for (int k = 0; k < kUnknowns; ++k) {
      const Unknowns step = (is_free_[static_cast<std::size_t>(k)] ? kSmall : 0.0) *
                            kScale[static_cast<std::size_t>(k)] * Unknowns::Unit(k);
      const Flight forward = changed(step);
      const Flight backward = changed(-step);
      const double length = (forward.unknowns[k] - backward.unknowns[k]) / kScale[static_cast<std::size_t>(k)];
      J.col(k).setZero();
      if (length > 0.0) J.col(k) = (residuals(forward) - residuals(backward)) / length;
      const double prior = kScale[static_cast<std::size_t>(k)] / kPrior[static_cast<std::size_t>(k)];
      normal.information(k, k) = prior * prior;
      normal.gradient[k] =
          (flight_.unknowns[k] - usual_[k]) / kScale[static_cast<std::size_t>(k)] * normal.information(k, k);
    }
    add_rows(r, J, kernel_sigmas, 2.0 * kSmall, normal);
    const Eigen::Map<const Unknowns> scale(kScale.data());
    Unknowns moved = Unknowns::Zero();
    damped_descent(normal, [&](const Eigen::VectorXd& change) {
      const Unknowns scaled = scale.cwiseProduct(Unknowns(change));
      const Flight next = changed(scaled);
      if (gain_of(residuals(next), r, kernel_sigmas) < 0.0) return false;
      flight_ = next;
      moved = scaled;
      return true;
    });
    sigmas_ = scale.cwiseProduct(Unknowns(normal.information.inverse().diagonal().cwiseMax(0.0).cwiseSqrt()));
    return moved.cwiseQuotient(sigmas_).cwiseAbs().maxCoeff();
  }

  // Every step on its own, the flight as a whole held; a step's faces and edges are seen by its own beams alone.
  void fit_steps(double kernel_sigmas) {
    constexpr double kSmall_m = 1e-4;
    const Eigen::Index steps = flight_.ahead.size();
    constexpr double kPriorInformation = 1.0 / (kSurelyUneven_m * kSurelyUneven_m);
    Normal normal{kPriorInformation * Eigen::MatrixXd::Identity(2 * steps, 2 * steps), Eigen::VectorXd(2 * steps)};
    normal.gradient << kPriorInformation * flight_.ahead, kPriorInformation * flight_.up;
    const Eigen::VectorXd r = residuals(flight_);
    Eigen::MatrixXd J = Eigen::MatrixXd::Zero(r.size(), 2 * steps);
    Eigen::VectorXd ahead(r.size()), behind(r.size());
    for (Eigen::Index column = 0; column < 2 * steps; ++column) {
      const Eigen::Index step = column % steps;
      const Look forward = look(with_step_moved(column, kSmall_m));
      const Look backward = look(with_step_moved(column, -kSmall_m));
      for (std::size_t i = 0; i < beams_.size(); ++i) {
        if (step < beams_[i].first_step - 1 || step > beams_[i].last_step + 1) continue;
        put_residual(i, forward, ahead);
        put_residual(i, backward, behind);
        for (const Eigen::Index row : {2 * static_cast<Eigen::Index>(i), 2 * static_cast<Eigen::Index>(i) + 1})
          J(row, column) = (ahead[row] - behind[row]) / (2.0 * kSmall_m);
      }
    }
    add_rows(r, J, kernel_sigmas, 2.0 * kSmall_m, normal);
    damped_descent(normal, [&](const Eigen::VectorXd& change) {
      Flight next = flight_;
      next.ahead += change.head(steps);
      next.up += change.tail(steps);
      if (gain_of(residuals(next), r, kernel_sigmas) < 0.0) return false;
      flight_ = next;
      return true;
    });
    step_sigmas_ = normal.information.inverse().diagonal().cwiseMax(0.0).cwiseSqrt();
  }

  Flight with_step_moved(Eigen::Index column, double by_m) const {
    Flight flight = flight_;
    const Eigen::Index steps = flight.ahead.size();
    (column < steps ? flight.ahead : flight.up)[column % steps] += by_m;
    return flight;
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

  StairModel model() const {
    StairModel model = start_.model;
    const double number = start_.first;
    model.depth_m += flight_.unknowns[kDepth];
    model.height_m += flight_.unknowns[kRise];
    model.overhang_m = flight_.unknowns[kOverhang];
    model.tread_thickness_m = flight_.unknowns[kThickness];
    model.descent = Eigen::AngleAxisd(flight_.unknowns[kHeading], Eigen::Vector3d::UnitZ()) * start_.model.descent;
    const Eigen::Vector3d lowest =
        frame_.nosing - flight_.unknowns[kAlong] * model.descent + flight_.unknowns[kUp] * Eigen::Vector3d::UnitZ();
    model.nosing = lowest + number * model.depth_m * model.descent - number * model.height_m * Eigen::Vector3d::UnitZ();
    return model;
  }

  const BeamFitStart& start_;
  const bool open_risers_;
  const BeamFitOptions& options_;
  StepFrame frame_;
  StepPoint sensor_;
  Flight flight_;
  std::array<bool, kUnknowns> is_free_{};
  Unknowns usual_ = Unknowns::Zero();
  Unknowns sigmas_ = Unknowns::Zero();
  Eigen::VectorXd step_sigmas_;
  std::vector<StairBeam> beams_;
};

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
  const auto fit_as = [&](bool open_risers, bool is_regular) {
    BeamFitStart as = start;
    if (is_regular) as.offsets.clear();
    return BeamFitter(corridor, as, open_risers, options).run();
  };
  // What explains more beams is true; what is unusual must explain clearly more. Risers are tried first: taken for a
  // backdrop behind open ones they would explain nearly as much.
  constexpr double kWell = 0.75;
  constexpr double kClearlyMore = 0.03;
  const auto explained = [](const std::optional<BeamFit>& fit) { return fit ? fit->explained : 0.0; };
  bool open_risers = false;
  std::optional<BeamFit> best = fit_as(false, true);
  if (explained(best) < kWell) {
    std::optional<BeamFit> open = fit_as(true, true);
    open_risers = explained(open) > explained(best);
    if (open_risers) best = std::move(open);
  }
  if (start.offsets.empty() || (explained(best) > kWell && !are_irregular(best->offsets))) return best;
  std::optional<BeamFit> irregular = fit_as(open_risers, false);
  return explained(irregular) > explained(best) + kClearlyMore ? irregular : best;
}

}  // namespace stairway::detect
