// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "detector/beam_residuals.hpp"

#include <cmath>
#include <limits>

namespace stairway::detect {

BeamResiduals::Look BeamResiduals::look(const MovedFlight& flight) const {
  const double u = sensor_.u * std::cos(flight.unknowns[kHeading]) + sensor_.v * std::sin(flight.unknowns[kHeading]);
  return {.faces = visible_faces(flight.shape(base_), {u, sensor_.z}), .radius_rad = flight.unknowns[kSpot]};
}

std::vector<BeamResiduals::Sight> BeamResiduals::sights(const MovedFlight& flight) const {
  const double cosine = std::cos(flight.unknowns[kHeading]);
  const double sine = std::sin(flight.unknowns[kHeading]);
  std::vector<Sight> sights;
  sights.reserve(beams_.size());
  for (const StairBeam& beam : beams_) {
    const double u = beam.u * cosine + beam.v * sine;
    const double plane_m = std::sqrt(u * u + beam.z * beam.z);
    const double whole_m = std::sqrt(beam.u * beam.u + beam.v * beam.v + beam.z * beam.z);
    sights.push_back({{u, beam.z, plane_m}, plane_m, whole_m / plane_m});
  }
  return sights;
}

Eigen::Vector2d BeamResiduals::rows_of(const StairBeam& beam, const Sight& sight, const Look& look) const {
  constexpr double kUnevenSpot = 0.05;  // what a share of the spot may be off by, for its light is not quite even
  constexpr double kShareSigma = 0.3;   // of the share, where the larger of two surfaces answers alone
  constexpr double kAnyOther_m = 0.10;  // an echo farther from both was something else's
  const Eigen::Vector2d unknown(std::numeric_limits<double>::quiet_NaN(), 0.0);
  const auto& [elevation, plane_m, scale] = sight;
  const SpotEcho echo =
      echo_of(look.faces, elevation, look.radius_rad * scale, beam.backdrop, pulse_separation_m_ / scale);
  if (!echo.is_known) return unknown;
  const auto over_sigma = [&](double off_m) {
    const double uneven_m = kUnevenSpot * echo.spread_m * scale;
    return off_m * scale / std::sqrt(range_sigma_m_ * range_sigma_m_ + uneven_m * uneven_m);
  };
  // What lies past the flight is not what is fitted.
  if (echo.is_past) return {0.0, plane_m < echo.range_m - kAnyOther_m ? 1.0 / kShareSigma : 0.0};
  if (!echo.is_split) return {over_sigma(plane_m - echo.range_m), 0.0};
  const bool is_near = std::abs(plane_m - echo.near_m) < std::abs(plane_m - echo.far_m);
  if (std::abs(plane_m - (is_near ? echo.near_m : echo.far_m)) > kAnyOther_m) return unknown;
  return {is_near ? over_sigma(plane_m - echo.near_m) : 0.0, ((is_near ? 1.0 : 0.0) - echo.near_share) / kShareSigma};
}

Eigen::VectorXd BeamResiduals::of(const MovedFlight& flight, const std::vector<Sight>& sights) const {
  const Look view = look(flight);
  Eigen::VectorXd rows(2 * static_cast<Eigen::Index>(beams_.size()));
  for (std::size_t i = 0; i < beams_.size(); ++i)
    rows.segment<2>(2 * static_cast<Eigen::Index>(i)) = rows_of(beams_[i], sights[i], view);
  return rows;
}

Eigen::MatrixXd BeamResiduals::derived(const MovedFlight& flight, const Eigen::VectorXd& r,
                                       const std::array<bool, kFlightUnknowns>& is_free, double reach) const {
  const std::vector<Sight> unturned = sights(flight);
  Eigen::MatrixXd J = Eigen::MatrixXd::Zero(r.size(), kFlightUnknowns);
  for (std::size_t i = 0; i < kFlightUnknowns; ++i) {
    if (!is_free[i]) continue;
    const auto k = static_cast<Eigen::Index>(i);
    const FlightUnknowns step = reach * kFlightScale[i] * FlightUnknowns::Unit(k);
    MovedFlight moved = flight.changed(step);
    if (moved.unknowns[k] == flight.unknowns[k]) moved = flight.changed(-step);  // at a bound
    const double moved_by = (moved.unknowns[k] - flight.unknowns[k]) / kFlightScale[i];
    J.col(k) = (of(moved, i == kHeading ? sights(moved) : unturned) - r) / moved_by;
  }
  return J;
}

Eigen::MatrixXd BeamResiduals::derived_by_steps(const MovedFlight& flight, double reach_m) const {
  const Eigen::Index steps = flight.ahead.size();
  const std::vector<Sight> sights = this->sights(flight);
  Eigen::MatrixXd J = Eigen::MatrixXd::Zero(2 * static_cast<Eigen::Index>(beams_.size()), 2 * steps);
  for (Eigen::Index offset = 0; offset < 2 * steps; ++offset) {
    const Eigen::Index step = offset % steps;
    const Look forward = look(flight.with_step_moved(offset, reach_m));
    const Look backward = look(flight.with_step_moved(offset, -reach_m));
    for (std::size_t i = 0; i < beams_.size(); ++i) {
      if (step < beams_[i].first_step - 1 || step > beams_[i].last_step + 1) continue;
      J.col(offset).segment<2>(2 * static_cast<Eigen::Index>(i)) =
          (rows_of(beams_[i], sights[i], forward) - rows_of(beams_[i], sights[i], backward)) / (2.0 * reach_m);
    }
  }
  return J;
}

}  // namespace stairway::detect
