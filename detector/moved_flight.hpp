// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "detector/stair_model.hpp"
#include "detector/stair_profile.hpp"
#include "detector/step_offsets.hpp"

namespace stairway::detect {

/// What a fit may change of a straight flight: place, depth, height and heading by how much; overhang, thickness and
/// the radius of the spot as they are. Metres and radians.
enum FlightUnknown { kAlong, kUp, kDepth, kRise, kHeading, kOverhang, kThickness, kSpot, kFlightUnknowns };
using FlightUnknowns = Eigen::Matrix<double, kFlightUnknowns, 1>;

/// Of what size changes are to be compared: metres, but angles seen over some metres.
inline constexpr std::array<double, kFlightUnknowns> kFlightScale{1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 0.2};
inline constexpr double kSurelyUneven_m = 0.03;  ///< by which a step may be off its place, one standard deviation
inline constexpr double kMostUneven_m = 0.06;    ///< what is farther off was not measured on the step

/// What stays while a flight is fitted.
struct FlightBase {
  StairModel model;  ///< straight, where the fit begins
  int first = 0;     ///< its lowest step, in whose axes the flight is told
  bool open_risers = false;
  bool from_above = false;  ///< the highest tread goes on as a floor, further steps below the lowest are hidden
};

/// A flight as a fit has moved it.
struct MovedFlight {
  FlightUnknowns unknowns = FlightUnknowns::Zero();
  Eigen::VectorXd ahead;  ///< how far each step lies beyond its regular place [m]
  Eigen::VectorXd up;     ///< and above it [m]

  /// With another change of the unknowns, within what stairs and spots may be.
  MovedFlight changed(const FlightUnknowns& by) const;
  /// With `by_m` more in one offset: of `ahead` first, then of `up`.
  MovedFlight with_step_moved(Eigen::Index offset, double by_m) const;
  StairProfileShape shape(const FlightBase& base) const;
  /// Regular, without the offsets.
  StairModel model(const FlightBase& base) const;
};

/// Where a fit begins: the model with given offsets of single steps, and a spot of `spot_radius_rad`.
MovedFlight unmoved(const FlightBase& base, int steps, const std::vector<StepOffset>& offsets, double spot_radius_rad);

/// What flights usually are, for what the beams leave open.
FlightUnknowns usual_flight(double spot_radius_rad);

/// How far each unknown may be from that, one standard deviation.
inline constexpr std::array<double, kFlightUnknowns> kFlightPrior{0.05, 0.05, 0.02, 0.02, 0.05, 0.010, 0.02, 0.5e-3};

}  // namespace stairway::detect
