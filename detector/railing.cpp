// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "detector/railing.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "detector/baluster_search.hpp"
#include "detector/flight_frame.hpp"
#include "detector/handrail_search.hpp"
#include "detector/voxel_grid.hpp"

namespace stairway::detect {
namespace {

constexpr double kEndSteps = 1.0;    // railings may begin before the first nosing and end behind the last
constexpr double kThinned_m = 0.01;  // else what is near the sensor would count for more
constexpr double kLowest_m = 0.1;    // balusters are looked for above the treads' own noise

// All that may belong to a railing, and more.
Eigen::AlignedBox3f box_about(const StairModel& model, const Interval& sides, int first, int last, double highest) {
  Eigen::AlignedBox3f box;
  for (int number = first - 2; number <= last + 2; ++number)
    for (const double side : {sides.low, sides.high})
      for (const double above : {-model.height_m, highest + model.height_m})
        box.extend(model.step(number).from_step({.v = side, .z = above}).cast<float>());
  return box;
}

// The points beside one end of the steps; `along`, how far beyond the end, above the nosings.
std::vector<Eigen::Vector3d> beside(const std::vector<FlightPoint>& points, const StairModel& model, double outward,
                                    double end, double reach) {
  std::vector<Eigen::Vector3d> result;
  for (const FlightPoint& p : points) {
    const double beyond = outward * (p.side_m - end);
    if (std::abs(beyond) <= reach) result.emplace_back(p.step * model.depth_m, beyond, p.above_m);
  }
  return result;
}

// How far beyond the end it runs.
std::optional<double> railing_beside(const std::vector<Eigen::Vector3d>& points, const RailingOptions& options) {
  if (const std::optional<double> handrail = find_handrail(points, options)) return handrail;
  return find_balusters(points, options);
}

}  // namespace

std::string RailingOptions::problem() const {
  if (!(max_side_distance_m > 0.0)) return "max_side_distance must be greater than 0";
  if (!(0.0 < min_handrail_height_m && min_handrail_height_m < max_handrail_height_m))
    return "handrail heights must satisfy 0 < minimum < maximum";
  if (!(max_handrail_angle_rad > 0.0 && max_baluster_angle_rad > 0.0)) return "the angles must be greater than 0";
  if (!(max_thickness_m > 0.0)) return "max_thickness must be greater than 0";
  if (!(min_handrail_length_m > 0.0)) return "min_handrail_length must be greater than 0";
  if (min_balusters < 2) return "min_balusters must be at least 2";
  return {};
}

Railing find_railing(const scan::PointCloud& cloud, const StairModel& model, const Interval& sides, int first, int last,
                     const RailingOptions& options) {
  if (!options.enabled) return {};
  const double reach = options.max_side_distance_m + options.max_thickness_m;
  const double highest = options.max_handrail_height_m + options.max_thickness_m;
  const auto is_beside = [&](const FlightPoint& p) {
    return p.step >= first - kEndSteps && p.step <= last + kEndSteps && p.above_m >= kLowest_m &&
           p.above_m <= highest && p.side_m >= sides.low - reach && p.side_m <= sides.high + reach;
  };
  const Eigen::AlignedBox3f box = box_about(model, {sides.low - reach, sides.high + reach}, first, last, highest);
  scan::PointCloud near;
  for (const Eigen::Vector3f& point : cloud.points)
    if (box.contains(point) && is_beside(to_flight(model, point.cast<double>()))) near.points.push_back(point);
  std::vector<FlightPoint> points;
  for (const Eigen::Vector3f& point : voxel_centroids(near, kThinned_m).points)
    points.push_back(to_flight(model, point.cast<double>()));
  const auto left = railing_beside(beside(points, model, +1.0, sides.high, reach), options);
  const auto right = railing_beside(beside(points, model, -1.0, sides.low, reach), options);
  return {.left = left.has_value(),
          .right = right.has_value(),
          .left_side_m = left ? sides.high + *left : 0.0,
          .right_side_m = right ? sides.low - *right : 0.0};
}

}  // namespace stairway::detect
