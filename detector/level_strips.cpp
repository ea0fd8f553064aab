// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "detector/level_strips.hpp"

#include <cmath>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>

#include "detector/cell_groups.hpp"
#include "detector/region_growing.hpp"
#include "detector/voxel_grid.hpp"

namespace stairway::detect {
namespace {

constexpr float kBelowFloor_m = 0.08F;
constexpr double kVoxel_m = 0.01;
constexpr double kThickness_m = 0.02;  // to each side, twice the noise
constexpr double kWide_m = 0.05;       // standard deviation: a region of that width has told its normal

bool is_a_plane_of_its_own(const scan::PointCloud& cloud, const PlaneRegion& region,
                           const PlaneFinderOptions& options) {
  return region.axes.variances[1] > kWide_m * kWide_m || find_stair_part(cloud, region, options);
}

std::vector<std::uint32_t> points_left_below(const scan::PointCloud& cloud, const std::vector<PlaneRegion>& regions,
                                             const PlaneFinderOptions& options) {
  std::vector<std::uint32_t> below;
  for (std::size_t i = 0; i < cloud.points.size(); ++i)
    if (cloud.points[i].z() < -kBelowFloor_m) below.push_back(static_cast<std::uint32_t>(i));
  if (below.empty()) return below;
  std::vector<bool> is_taken(cloud.points.size(), false);
  for (const PlaneRegion& region : regions)
    if (region.axes.centroid.z() < 0.0 && is_a_plane_of_its_own(cloud, region, options))
      for (const std::uint32_t point : region.points) is_taken[point] = true;
  std::erase_if(below, [&](std::uint32_t point) { return is_taken[point]; });
  return below;
}

// Where points are dense is a surface.
SurfaceNormals level_surface(const CellGroups& voxels) {
  SurfaceNormals surface;
  surface.normals.assign(voxels.size(), Eigen::Vector3f::UnitZ());
  for (std::size_t i = 0; i < voxels.size(); ++i)
    surface.variations.push_back(1.0F / static_cast<float>(voxels[i].size()));
  return surface;
}

// Walls and the ghosts between two surfaces go on above and below, and fill a region's thickness evenly.
bool is_as_thin_as_noise(const PrincipalAxes& axes) {
  constexpr double kThin_m = 0.0085;  // standard deviation; that of a slice as thick as a region may be is 12 mm
  return axes.axes.row(2).cwiseAbs2().dot(axes.variances) < kThin_m * kThin_m;
}

bool stands_out(const StairPart& strip, std::span<const Eigen::Vector3f> points) {
  constexpr double kAround_m = 0.04;
  constexpr double kMostOfThem = 0.7;
  const Eigen::Vector3d along = (strip.end_b - strip.end_a).normalized();
  const double half_width = 0.5 * strip.width();
  const double half_depth = 0.5 * (strip.front - strip.back).norm() + kAround_m;
  const Eigen::Vector3d middle = 0.5 * (strip.end_a + strip.end_b);
  double around = 0.0;
  double at_height = 0.0;
  for (const Eigen::Vector3f& point : points) {
    const Eigen::Vector3d off = point.cast<double>() - middle;
    if (std::abs(off.z()) > kAround_m || std::abs(off.dot(along)) > half_width ||
        std::abs(off.dot(strip.facing)) > half_depth)
      continue;
    around += 1.0;
    at_height += std::abs(off.z()) < kThickness_m ? 1.0 : 0.0;
  }
  return at_height > kMostOfThem * around;
}

PrincipalAxes level(PrincipalAxes axes) {
  const Eigen::Vector3d along = Eigen::Vector3d(axes.axes(0, 0), axes.axes(1, 0), 0.0).normalized();
  axes.axes << along, Eigen::Vector3d::UnitZ().cross(along), Eigen::Vector3d::UnitZ();
  return axes;
}

}  // namespace

std::vector<StairPart> find_level_strips(const scan::PointCloud& cloud, const std::vector<PlaneRegion>& regions,
                                         const PlaneFinderOptions& options) {
  constexpr RegionGrowingOptions kAtOneHeight{.max_plane_distance_m = kThickness_m};
  const std::vector<std::uint32_t> left = points_left_below(cloud, regions, options);
  scan::PointCloud loose{.points = {}, .sensor_origin = cloud.sensor_origin};
  for (const std::uint32_t point : left) loose.points.push_back(cloud.points[point]);
  const CellGroups voxels = group_by_cell(loose.points, kVoxel_m);
  const scan::PointCloud thinned = centroids(loose, voxels);
  const std::vector<std::uint32_t> weights(voxels.size(), 1);
  std::vector<StairPart> strips;
  for (const auto& set : grow_point_sets(thinned, level_surface(voxels), weights, kAtOneHeight)) {
    std::vector<std::uint32_t> points;
    for (const std::uint32_t voxel : set)
      for (const std::uint32_t point : voxels[voxel]) points.push_back(left[point]);
    PlaneRegion region = make_region(cloud.points, std::move(points), Eigen::Vector3d::UnitZ());
    if (!is_as_thin_as_noise(region.axes)) continue;
    region.axes = level(region.axes);
    std::optional<StairPart> tread = find_stair_part(cloud, region, options);
    if (!tread || tread->width() < options.min_edge_width_m || !stands_out(*tread, loose.points)) continue;
    tread->region = regions.size() + strips.size();
    strips.push_back(*tread);
  }
  return strips;
}

}  // namespace stairway::detect
