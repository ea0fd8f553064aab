// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "detector/moved_flight.hpp"

#include <algorithm>

namespace stairway::detect {
namespace {

constexpr double kUsualThickness_m = 0.04;
constexpr double kLeastThickness_m = 0.015;
constexpr double kMostThickness_m = 0.08;
constexpr double kMostOverhang_m = 0.06;
constexpr double kLeastRadius_rad = 0.5e-3;

}  // namespace

MovedFlight MovedFlight::changed(const FlightUnknowns& by) const {
  MovedFlight flight = *this;
  flight.unknowns += by;
  flight.unknowns[kOverhang] = std::clamp(flight.unknowns[kOverhang], 0.0, kMostOverhang_m);
  flight.unknowns[kThickness] = std::clamp(flight.unknowns[kThickness], kLeastThickness_m, kMostThickness_m);
  flight.unknowns[kSpot] = std::max(flight.unknowns[kSpot], kLeastRadius_rad);
  return flight;
}

MovedFlight MovedFlight::with_step_moved(Eigen::Index offset, double by_m) const {
  MovedFlight flight = *this;
  (offset < ahead.size() ? flight.ahead : flight.up)[offset % ahead.size()] += by_m;
  return flight;
}

StairProfileShape MovedFlight::shape(const FlightBase& base) const {
  constexpr double kFloor_m = 100.0;
  StairProfileShape shape{.overhang_m = unknowns[kOverhang],
                          .thickness_m = unknowns[kThickness],
                          .open_risers = base.open_risers,
                          .step_height_m = 0.5 * base.model.height_m,
                          .last_tread_m = base.from_above ? kFloor_m : 0.0,
                          .goes_on_below = base.from_above};
  for (Eigen::Index i = 0; i < ahead.size(); ++i) {
    const auto number = static_cast<double>(i);
    shape.nosings.emplace_back(unknowns[kAlong] + number * (base.model.depth_m + unknowns[kDepth]) + ahead[i],
                               unknowns[kUp] + number * (base.model.height_m + unknowns[kRise]) + up[i]);
  }
  return shape;
}

StairModel MovedFlight::model(const FlightBase& base) const {
  StairModel model = base.model;
  const double number = base.first;
  const Eigen::Vector3d up_axis = Eigen::Vector3d::UnitZ();
  model.depth_m += unknowns[kDepth];
  model.height_m += unknowns[kRise];
  model.overhang_m = unknowns[kOverhang];
  model.tread_thickness_m = unknowns[kThickness];
  model.descent = Eigen::AngleAxisd(unknowns[kHeading], up_axis) * base.model.descent;
  const Eigen::Vector3d lowest =
      base.model.step(base.first).nosing - unknowns[kAlong] * model.descent + unknowns[kUp] * up_axis;
  model.nosing = lowest + number * (model.depth_m * model.descent - model.height_m * up_axis);
  return model;
}

MovedFlight unmoved(const FlightBase& base, int steps, const std::vector<StepOffset>& offsets, double spot_radius_rad) {
  MovedFlight flight;
  flight.ahead = flight.up = Eigen::VectorXd::Zero(steps);
  for (const StepOffset& offset : offsets) {
    const int i = offset.number - base.first;
    if (i < 0 || i >= steps) continue;
    if (offset.ahead) flight.ahead[i] = std::clamp(offset.ahead->value, -kMostUneven_m, kMostUneven_m);
    if (offset.up) flight.up[i] = std::clamp(offset.up->value, -kMostUneven_m, kMostUneven_m);
  }
  flight.unknowns = usual_flight(spot_radius_rad);
  if (base.open_risers && base.model.tread_thickness_m > kLeastThickness_m)
    flight.unknowns[kThickness] = base.model.tread_thickness_m;
  return flight;
}

FlightUnknowns usual_flight(double spot_radius_rad) {
  FlightUnknowns usual = FlightUnknowns::Zero();
  usual[kThickness] = kUsualThickness_m;
  usual[kSpot] = spot_radius_rad;
  return usual;
}

}  // namespace stairway::detect
