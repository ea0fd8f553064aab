// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "detector/plane_finder.hpp"

#include <cmath>
#include <numbers>

#include "detector/extents.hpp"

namespace stairway::detect {
namespace {

// Wide enough to hold several beams at 6 m, narrow enough to have many strips on a tread.
constexpr double kStrip_m = 0.05;

Eigen::Vector3d horizontal_unit(const Eigen::Vector3d& v) { return Eigen::Vector3d(v.x(), v.y(), 0.0).normalized(); }

// Points that scatter by more than half a length fill more than that length.
bool surely_exceeds(const PlaneRegion& region, const Eigen::Vector3d& axis, double length_m) {
  const Eigen::Vector3d shares = region.axes.axes.transpose() * axis;
  return shares.cwiseAbs2().dot(region.axes.variances) > 0.25 * length_m * length_m;
}

std::optional<StairPart> as_riser(const scan::PointCloud& cloud, const PlaneRegion& region,
                                  const PlaneFinderOptions& options) {
  StairPart part{.kind = StairPart::Kind::Riser, .centroid = region.axes.centroid, .point_count = region.points.size()};
  part.facing = horizontal_unit(region.axes.normal());
  if (surely_exceeds(region, Eigen::Vector3d::UnitZ(), options.max_riser_height_m)) return std::nullopt;
  const Eigen::Vector3d across = Eigen::Vector3d::UnitZ().cross(part.facing);
  const Interval height = robust_extent(cloud.points, region.points, Eigen::Vector3d::UnitZ(), across, kStrip_m);
  if (height.length() >= options.max_riser_height_m) return std::nullopt;
  const Interval side = robust_extent(cloud.points, region.points, across, Eigen::Vector3d::UnitZ(), kStrip_m);
  if (side.length() < options.min_width_m || side.length() < height.length()) return std::nullopt;

  const Eigen::Vector3d middle = part.centroid + across * (side.middle() - part.centroid.dot(across));
  const auto at_height = [&](double z) { return Eigen::Vector3d(middle.x(), middle.y(), z); };
  part.top = at_height(height.high);
  part.bottom = at_height(height.low);
  part.front = part.back = at_height(height.middle());
  part.end_a = part.front - across * (0.5 * side.length());
  part.end_b = part.front + across * (0.5 * side.length());
  return part;
}

std::optional<StairPart> as_tread(const scan::PointCloud& cloud, const PlaneRegion& region,
                                  const PlaneFinderOptions& options) {
  StairPart part{.kind = StairPart::Kind::Tread, .centroid = region.axes.centroid, .point_count = region.points.size()};
  part.from_below = cloud.sensor_origin && cloud.sensor_origin->z() < static_cast<float>(part.centroid.z());
  part.facing = horizontal_unit(region.axes.axes.col(1));
  if (surely_exceeds(region, part.facing, options.max_tread_depth_m)) return std::nullopt;
  const Eigen::Vector3d across = Eigen::Vector3d::UnitZ().cross(part.facing);
  const Interval depth = robust_extent(cloud.points, region.points, part.facing, across, kStrip_m);
  if (depth.length() >= options.max_tread_depth_m) return std::nullopt;
  const Interval side = robust_extent(cloud.points, region.points, across, part.facing, kStrip_m);
  if (side.length() < options.min_width_m || side.length() < depth.length()) return std::nullopt;

  const auto at = [&](double along, double aside) {
    return Eigen::Vector3d(part.facing * along + across * aside + Eigen::Vector3d(0.0, 0.0, part.centroid.z()));
  };
  part.top = part.bottom = part.centroid;
  part.front = at(depth.high, side.middle());
  part.back = at(depth.low, side.middle());
  part.end_a = at(depth.middle(), side.low);
  part.end_b = at(depth.middle(), side.high);
  return part;
}

}  // namespace

std::string PlaneFinderOptions::problem() const {
  if (!(max_tilt_rad > 0.0 && max_tilt_rad < std::numbers::pi / 4)) return "max_tilt must lie between 0 and 45 degrees";
  if (!(max_riser_height_m > 0.0)) return "max_riser_height_m must be greater than 0";
  if (!(max_tread_depth_m > 0.0)) return "max_tread_depth_m must be greater than 0";
  if (!(min_width_m >= 0.0)) return "min_width_m must not be negative";
  return {};
}

std::optional<StairPart> find_stair_part(const scan::PointCloud& cloud, const PlaneRegion& region,
                                         const PlaneFinderOptions& options) {
  const double upward = std::abs(region.axes.normal().z());
  if (upward < std::sin(options.max_tilt_rad)) return as_riser(cloud, region, options);
  if (upward > std::cos(options.max_tilt_rad)) return as_tread(cloud, region, options);
  return std::nullopt;
}

std::optional<StairPart> find_edge(const scan::PointCloud& cloud, const PlaneRegion& region,
                                   const PlaneFinderOptions& options) {
  const Eigen::Vector3d length = region.axes.axes.col(0);
  if (!options.find_edges || std::abs(length.z()) > std::sin(options.max_edge_tilt_rad)) return std::nullopt;
  StairPart part{.kind = StairPart::Kind::Edge,
                 .centroid = region.axes.centroid,
                 .facing = length.cross(Eigen::Vector3d::UnitZ()).normalized(),
                 .point_count = region.points.size()};
  if (surely_exceeds(region, Eigen::Vector3d::UnitZ(), options.max_edge_thickness_m) ||
      surely_exceeds(region, part.facing, options.max_edge_thickness_m))
    return std::nullopt;
  const Eigen::Vector3d across = Eigen::Vector3d::UnitZ().cross(part.facing);
  const Interval height = robust_extent(cloud.points, region.points, Eigen::Vector3d::UnitZ(), across, kStrip_m);
  const Interval depth = robust_extent(cloud.points, region.points, part.facing, across, kStrip_m);
  if (std::max(height.length(), depth.length()) > options.max_edge_thickness_m) return std::nullopt;
  const Interval side = robust_extent(cloud.points, region.points, across, part.facing, kStrip_m);
  if (side.length() < options.min_edge_width_m) return std::nullopt;
  part.top = part.bottom = part.front = part.back = part.centroid;
  part.end_a = part.centroid + across * (side.low - part.centroid.dot(across));
  part.end_b = part.centroid + across * (side.high - part.centroid.dot(across));
  return part;
}

}  // namespace stairway::detect
