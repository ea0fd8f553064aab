// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "detector/stair_corridor.hpp"
#include "detector/stair_model.hpp"

namespace stairway::detect {

/// A measured value and its standard deviation.
struct Estimate {
  double value = 0.0;
  double sigma = 0.0;
};

/// A line of sight that just passes over a nosing, in the vertical plane along the ascent of its step: the nosing lies
/// on it, wherever along it that is.
struct NosingSight {
  StepPoint at;                ///< a point of the line; its v is the middle of the sides [m]
  double along_u = 1.0;        ///< the line's unit direction
  double along_z = 0.0;        ///< likewise
  double sigma_m = 0.0;        ///< across the line
  double distance_m = 0.0;     ///< of the nosing from the sensor; 0 without one
  bool without_sight = false;  ///< nobody knows the sensor: the highest points of a front, too high by a common amount
  bool over_a_front = true;  ///< seen from before the step, over the top of its front; else from behind, over its tread
};

/// What the points themselves, not the segmented planes, say about one step, in the axes of `frame`.
struct StepMeasurement {
  int number = 0;
  StepFrame frame;                    ///< where the model had the step when it was measured
  double middle_v = 0.0;              ///< of the sides [m]
  double distance_m = 0.0;            ///< of the nosing from the sensor; 0 without one
  std::optional<Estimate> front;      ///< u of the riser, or of an open tread's front face, at `middle_v`
  bool has_riser = false;             ///< the front fills the height of the step
  bool is_bar = false;                ///< the front is that of the tread or its lip alone, which mixed pixels shift
  std::optional<Estimate> lip;        ///< u of the upper end of the front, which an overhang sets before the rest
  std::optional<Estimate> turn;       ///< slope du/dv of that front or of the tread's edge [rad]
  std::optional<Estimate> surface;    ///< z of the tread
  bool is_landing = false;            ///< the surface goes on before where the nosing would be: no tread, but a floor
  std::optional<Estimate> underside;  ///< z of the tread's underside
  std::optional<NosingSight> nosing;
  std::optional<Estimate> right_end;  ///< v at which the line of sight leaves the front to the right
  std::optional<Estimate> left_end;   ///< likewise to the left
  std::optional<double> right_limit;  ///< v of the first free line of sight beyond the right end
  std::optional<double> left_limit;   ///< likewise to the left

  bool seen() const { return front || surface || underside; }
  int count() const;  ///< how many of fronts, surfaces and undersides there are
};

struct StepMeasurementOptions {
  double range_sigma_m = 0.010;  ///< white noise of one point [m], > 0
  double spot_rad =
      13.3e-3;  ///< full angle of the sensor's beam [rad]: points nearer to an edge than half of it are mixed
  double search_m = 0.05;     ///< fronts and surfaces are looked for this far from where the model has them [m], > 0
  int min_points = 15;        ///< of a front or a surface
  double min_coverage = 0.4;  ///< share of the sides, in strips of 10 cm, that a front or surface must cover
  double min_contrast = 2.0;  ///< density of points on a front or surface against that of the space around it

  std::string problem() const;
};

/// Measures step `number` of `model`, which may have moved a little since the corridor was cut.
///
/// A front is measured where the sensor stands before it, a tread where it stands above it, an underside where it
/// stands below it; all three when nobody knows where it stood.
/// @param sides  of the stairway, along left() from the middle line of the model [m]; their length must be positive.
/// Cost: O(n) in the points of the corridor.
StepMeasurement measure_step(const StairCorridor& corridor, const StairModel& model, const Interval& sides, int number,
                             const StepMeasurementOptions& options);

}  // namespace stairway::detect
