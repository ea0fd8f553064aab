// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "detector/step_measurement.hpp"

#include <cmath>

#include "detector/step_edges.hpp"
#include "detector/step_front.hpp"
#include "detector/step_level.hpp"
#include "detector/step_view.hpp"

namespace stairway::detect {
namespace {

constexpr double kThinnestTread_m = 0.015;
constexpr double kThickestTread_m = 0.12;

void measure_levels(const StepView& view, StepMeasurement& step) {
  const double search = view.options().search_m;
  if (!view.sensor() || view.sensor()->z > 0.0) step.surface = measure_level(view, {-search, search});
  if (!view.sensor() || view.sensor()->z < 0.0)
    step.underside = measure_level(view, {-kThickestTread_m, -kThinnestTread_m});
  step.is_landing = step.surface && goes_on_before(view, step.surface->value);
}

void measure_edges(const StepView& view, StepMeasurement& step) {
  if (step.front) {
    step.nosing = nosing_over_front(view, step.front->value);
    if (!view.sensor()) return;
    if (const std::optional<EndMeasurement> end = end_of_front(view, view.sides().low)) {
      step.right_end = end->place;
      step.right_limit = end->limit;
    }
    if (const std::optional<EndMeasurement> end = end_of_front(view, view.sides().high)) {
      step.left_end = end->place;
      step.left_limit = end->limit;
    }
  } else if (step.surface && view.stands_behind_nosing()) {
    if (const std::optional<EdgeMeasurement> edge = nosing_over_tread(view)) {
      step.nosing = edge->nosing;
      step.turn = edge->turn;
    }
    if (const auto end = end_of_tread(view, view.sides().low)) step.right_end = end->place;
    if (const auto end = end_of_tread(view, view.sides().high)) step.left_end = end->place;
  }
}

void measure_inner_end(const StepView& view, StepMeasurement& step) {
  std::optional<Estimate>& end = view.model().turn_rad > 0.0 ? step.left_end : step.right_end;
  end.reset();
  if (step.underside) end = inner_end(view, step.underside->value);
  if (!end && step.surface) end = inner_end(view, step.surface->value);
}

}  // namespace

int StepMeasurement::count() const {
  return static_cast<int>(front.has_value()) + static_cast<int>(surface.has_value()) +
         static_cast<int>(underside.has_value());
}

std::string StepMeasurementOptions::problem() const {
  if (!(range_sigma_m > 0.0)) return "range_sigma_m must be greater than 0";
  if (!(spot_rad >= 0.0)) return "spot must not be negative";
  if (!(search_m > 0.0)) return "search_m must be greater than 0";
  if (min_points < 3) return "min_points must be at least 3";
  return {};
}

StepMeasurement measure_step(const StairCorridor& corridor, const StairModel& model, const Interval& sides, int number,
                             const StepMeasurementOptions& options) {
  const StepView view(corridor, model, sides, number, options);
  StepMeasurement step{.number = number, .frame = view.frame(), .middle_v = sides.middle()};
  if (view.sensor())
    step.distance_m = std::hypot(view.sensor()->u, sides.middle() - view.sensor()->v, view.sensor()->z);
  if (view.faces_front()) {
    if (const std::optional<FrontMeasurement> front = measure_front(view)) {
      step.front = front->place;
      step.turn = front->turn;
      step.has_riser = front->has_riser;
      step.is_bar = front->is_bar;
      step.lip = measure_lip(view);
    }
  }
  measure_levels(view, step);
  measure_edges(view, step);
  if (model.is_spiral()) measure_inner_end(view, step);
  return step;
}

}  // namespace stairway::detect
