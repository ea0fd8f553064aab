// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

namespace stairway::scan {

/// Points in one frame (`base` unless said otherwise) [m].
struct PointCloud {
  std::vector<Eigen::Vector3f> points;
  /// Where the sensor stood, in the frame of the points [m]; tells the upper side of a plane from its underside.
  /// Empty for clouds merged from several places.
  std::optional<Eigen::Vector3f> sensor_origin;
};

}  // namespace stairway::scan
