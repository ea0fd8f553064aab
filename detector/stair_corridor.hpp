// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>
#include <vector>

#include "detector/extents.hpp"
#include "detector/sight_fan.hpp"
#include "detector/stair_model.hpp"
#include "scan_assembly/point_cloud.hpp"

namespace stairway::detect {

/// The points of a stairway and of what is seen past its edges, picked from a cloud once to be measured repeatedly.
class StairCorridor {
 public:
  /// @param cloud  all points, not thinned: edges are found between neighbouring beams; those that are not finite are
  ///               left out.
  /// @param sides  of the stairway, along left() from the middle line of the model [m].
  /// Cost: one pass over the cloud.
  StairCorridor(const scan::PointCloud& cloud, const StairModel& model, const Interval& sides);

  const std::vector<Eigen::Vector3d>& points() const { return points_; }
  /// A part of them that holds every one that lies within the hull of the corners or is seen past it. Small for a small
  /// thing if the sensor is known.
  std::span<const Eigen::Vector3d> points_at(std::span<const Eigen::Vector3d> corners) const;
  /// Where the sensor stood, in the frame of the cloud; nothing when unknown or more than one place.
  const std::optional<Eigen::Vector3d>& sensor() const { return sensor_; }

 private:
  void sort_around_spiral(const StairModel& model);

  std::vector<Eigen::Vector3d> points_;
  std::optional<Eigen::Vector3d> sensor_;
  std::optional<SightFan> fan_;
};

}  // namespace stairway::detect
