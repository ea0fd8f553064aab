// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace stairway::detect {

/// Points in the order in which a look of the sensor that turns in one plane passes them, so that those behind or
/// within a small thing follow each other.
class SightFan {
 public:
  /// @param points  are put into that order; those in one of its steps of a tenth of a degree keep theirs.
  /// @param start   unit direction in which the turn begins and ends: where nothing small is asked for.
  /// @param ahead   unit direction after the first quarter of the turn.
  /// Cost: O(n).
  SightFan(std::vector<Eigen::Vector3d>& points, const Eigen::Vector3d& sensor, const Eigen::Vector3d& start,
           const Eigen::Vector3d& ahead);

  /// [first, last): holds every point that lies within the hull of the corners or behind it; all when the sensor is
  /// within it or looks at it in the direction of the start. @pre corners is not empty.
  std::pair<std::size_t, std::size_t> within_or_behind(std::span<const Eigen::Vector3d> corners) const;

 private:
  Eigen::Vector2d in_plane(const Eigen::Vector3d& p) const {
    return {(p - sensor_).dot(ahead_), (p - sensor_).dot(start_)};
  }

  Eigen::Vector3d sensor_;
  Eigen::Vector3d start_;
  Eigen::Vector3d ahead_;
  std::vector<std::uint32_t> starts_;
};

}  // namespace stairway::detect
