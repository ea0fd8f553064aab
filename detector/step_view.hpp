// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "detector/stair_corridor.hpp"
#include "detector/step_measurement.hpp"

namespace stairway::detect {

/// One step as the sensor sees it: the points near it or seen past its edges, in the step's own axes.
class StepView {
 public:
  /// Cost: O(n) in the points of the corridor that lie at the step. `options` must outlive the view.
  StepView(const StairCorridor& corridor, const StairModel& model, const Interval& sides, int number,
           const StepMeasurementOptions& options);

  const StepFrame& frame() const { return frame_; }
  const StairModel& model() const { return model_; }
  const Interval& sides() const { return sides_; }
  const StepMeasurementOptions& options() const { return options_; }
  const std::vector<StepPoint>& points() const { return points_; }
  const std::optional<StepPoint>& sensor() const { return sensor_; }

  double front_u() const { return model_.overhang_m; }             ///< where the model has the front [m]
  double reach_m() const { return 2.5 * options_.range_sigma_m; }  ///< a point belongs to a face up to this far from it
  double depth_at(double v) const { return next_.u + (v - next_.v) * next_slope_; }  ///< u of the next nosing [m]
  bool lies_between_sides(const StepPoint& p) const { return p.v >= sides_.low && p.v <= sides_.high; }

  bool faces_front() const;           ///< the sensor stands before the front, or nobody knows where
  bool stands_behind_nosing() const;  ///< and above the tread: it sees the tread's edge from behind
  bool stands_behind_tread() const;   ///< likewise, and looks over the next nosing

  /// Where the line of sight to a point passes the plane of the front; without a sensor the point itself.
  StepPoint at_front(const StepPoint& p) const { return at_upright(p, front_u()); }
  /// Likewise the upright plane at `u` along the ascent.
  StepPoint at_upright(const StepPoint& p, double u) const;
  /// Likewise the plane of the tread. @pre the sensor is above it.
  StepPoint at_tread(const StepPoint& p) const;

  bool has_lip() const;             ///< the model lets its nosings stand out before the fronts
  double spot_radius_m() const;     ///< half the width of the beam's spot at the nosing; 0 without a sensor
  double visible_bottom_m() const;  ///< the lowest z of the front that the nosing below lets one see

  /// Whether places along v cover the sides as StepMeasurementOptions::min_coverage asks.
  bool covers_sides(const std::vector<double>& places) const;
  bool are_enough(std::size_t points) const { return points >= static_cast<std::size_t>(options_.min_points); }

 private:
  double margin_m() const { return 2.0 * options_.search_m; }
  std::array<Eigen::Vector3d, 8> surroundings() const;
  bool is_worth_a_look(const StepPoint& p) const;

  StairModel model_;
  Interval sides_;
  const StepMeasurementOptions& options_;
  StepFrame frame_;
  std::optional<StepPoint> sensor_;
  StepPoint next_;  // the next nosing, which on a spiral is turned against this one
  double next_slope_ = 0.0;
  std::vector<StepPoint> points_;
};

/// Median and its standard error from the median absolute deviation, not below `floor`. @pre not empty.
Estimate robust_mean(const std::vector<double>& values, double floor);

/// Where the densest window of half-width `reach` among sorted values is centred. @pre not empty.
double densest_place(const std::vector<double>& sorted, double reach);

}  // namespace stairway::detect
