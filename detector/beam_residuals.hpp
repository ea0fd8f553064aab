// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "detector/moved_flight.hpp"
#include "detector/stair_beams.hpp"

namespace stairway::detect {

/// What beams differ by from what a flight would have them measure, in sigmas.
///
/// Two rows a beam: the first for its range, NaN where nobody can tell what it should be; the second for the share of
/// the spot on the surface that answered, where two lie too far apart to answer together.
class BeamResiduals {
 public:
  /// @param sensor  in the axes of the lowest step where the fit begins, like the beams.
  BeamResiduals(const FlightBase& base, const StepPoint& sensor, std::vector<StairBeam> beams, double range_sigma_m,
                double pulse_separation_m)
      : base_(base),
        sensor_(sensor),
        beams_(std::move(beams)),
        range_sigma_m_(range_sigma_m),
        pulse_separation_m_(pulse_separation_m) {}

  const std::vector<StairBeam>& beams() const { return beams_; }
  double sensor_distance_m() const { return std::hypot(sensor_.u, sensor_.v, sensor_.z); }

  /// Of all beams. Cost: O(n log n) in steps and beams.
  Eigen::VectorXd of(const MovedFlight& flight) const { return of(flight, sights(flight)); }

  /// The rows `r` of a flight, derived by each of its unknowns that is free, per `kFlightScale` of it, over `reach` of
  /// those; the others' columns are 0.
  Eigen::MatrixXd derived(const MovedFlight& flight, const Eigen::VectorXd& r,
                          const std::array<bool, kFlightUnknowns>& is_free, double reach) const;

  /// The rows of of(), derived by the offsets of single steps (first ahead, then up) over `reach_m` to both sides.
  /// A step's faces and edges are seen by its own beams alone, so the others are left at 0.
  Eigen::MatrixXd derived_by_steps(const MovedFlight& flight, double reach_m) const;

 private:
  /// The profile a flight shows to the sensor, ready to be asked by beams.
  struct Look {
    std::vector<VisibleFace> faces;
    double radius_rad = 0.0;
  };
  /// A beam within the plane of the profile, which the flight's heading turns.
  struct Sight {
    Elevation elevation;
    double plane_m = 0.0;  ///< how far it went there
    double scale = 1.0;    ///< and in space, by this factor
  };
  Look look(const MovedFlight& flight) const;
  std::vector<Sight> sights(const MovedFlight& flight) const;
  Eigen::VectorXd of(const MovedFlight& flight, const std::vector<Sight>& sights) const;
  Eigen::Vector2d rows_of(const StairBeam& beam, const Sight& sight, const Look& look) const;

  FlightBase base_;
  StepPoint sensor_;
  std::vector<StairBeam> beams_;
  double range_sigma_m_;
  double pulse_separation_m_;
};

}  // namespace stairway::detect
