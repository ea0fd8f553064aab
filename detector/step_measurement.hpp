// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "detector/stair_model.hpp"
#include "scan_assembly/point_cloud.hpp"

namespace stairway::detect {

/// A measured value and its standard deviation.
struct Estimate {
  double value = 0.0;
  double sigma = 0.0;
};

/// What the points themselves, not the segmented planes, say about one step; in the axes of the model:
/// u along the ascent (-s), v along left(), z up, all through the origin of the frame [m].
struct StepMeasurement {
  int number = 0;
  std::optional<Estimate> front;      ///< u of the riser, or of an open tread's front face, in the middle of the side
  std::optional<Estimate> turn;       ///< slope du/dv of that front [rad]: how far s is turned from it
  std::optional<Estimate> surface;    ///< z of the tread
  std::optional<Estimate> underside;  ///< z of the tread's underside
  std::optional<Estimate> nosing;     ///< z at `nosing_u` of the line of sight that leaves the front at its top
  double nosing_u = 0.0;
  std::optional<Estimate> right_end;  ///< v at which the line of sight leaves the front to the right
  std::optional<Estimate> left_end;   ///< likewise to the left

  bool seen() const { return front || surface || underside; }
};

struct StepMeasurementOptions {
  double range_sigma_m = 0.010;  ///< white noise of one point [m], > 0
  double spot_rad =
      13.3e-3;  ///< full angle of the sensor's beam [rad]: points nearer to an edge than half of it are mixed
  double search_m = 0.05;     ///< fronts and surfaces are looked for this far from where the model has them [m], > 0
  int min_points = 15;        ///< of a front or a surface
  double min_coverage = 0.4;  ///< share of the side, in strips of 10 cm, that a front or surface must cover
  double min_contrast = 2.0;  ///< density of points on a front or surface against that of the space around it

  std::string problem() const;
};

/// The points of a stairway and of what is seen just past its edges, picked from a cloud once and measured repeatedly.
class StairCorridor {
 public:
  /// @param cloud  all points, not thinned: edges are found between neighbouring beams.
  /// Cost: one pass over the cloud.
  StairCorridor(const scan::PointCloud& cloud, const StairModel& model, const Interval& side);

  /// Where the sensor stood, in the frame of the cloud.
  const std::optional<Eigen::Vector3d>& sensor() const { return sensor_; }

  /// Measures steps `first`..`last` of `model`, which may have moved a little since the corridor was cut.
  /// @param side  of the stairway, along left() of the model.
  std::vector<StepMeasurement> measure(const StairModel& model, const Interval& side, int first, int last,
                                       const StepMeasurementOptions& options) const;

 private:
  std::vector<Eigen::Vector3d> points_;
  std::optional<Eigen::Vector3d> sensor_;
};

}  // namespace stairway::detect
