// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "tools/evaluation/segmentation_truth.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <set>
#include <utility>

namespace stairway::evaluation {
namespace {

// Places on edges are seen a little in front of or behind the surface that is really there.
constexpr float kSightTolerance_m = 0.005F;

using CellIndex = std::pair<int, int>;

CellIndex cell_of(const Eigen::Vector2d& flat, double cell_m) {
  return {static_cast<int>(std::floor(flat.x() / cell_m)), static_cast<int>(std::floor(flat.y() / cell_m))};
}

bool sees(const sim::Bvh& scene, const Eigen::Vector3f& sensor, const Eigen::Vector3d& place) {
  const Eigen::Vector3f to_place = place.cast<float>() - sensor;
  const float range = to_place.norm();
  return scene.cast(sensor, to_place / range, range).range_m >= range - kSightTolerance_m;
}

// How far the point is from the surface; nothing beyond `limit_m`.
std::optional<double> distance(const TruthPlane& plane, const Eigen::Vector3d& point, double limit_m) {
  const double height = plane.height(point);
  if (std::abs(height) > limit_m) return std::nullopt;
  const Eigen::Vector2d flat = plane.flatten(point);
  const double total = std::hypot(height, (plane.nearest(flat) - flat).norm());
  return total > limit_m ? std::nullopt : std::optional(total);
}

using Cells = std::set<CellIndex>;

Cells cells_of(const TruthPlane& plane, const TruthRules& rules) {
  Cells cells;
  for (const Eigen::Vector2d& place : plane.raster(rules.raster_m, rules.margin_m))
    cells.insert(cell_of(place, rules.cell_m));
  return cells;
}

Cells cells_of(const detect::PlaneRegion& region, std::span<const Eigen::Vector3f> points, const TruthPlane& plane,
               const TruthRules& rules) {
  Cells cells;
  for (const std::uint32_t i : region.points)
    cells.insert(cell_of(plane.flatten(points[i].cast<double>()), rules.cell_m));
  return cells;
}

double ratio(std::size_t part, std::size_t whole) {
  return whole == 0 ? 0.0 : static_cast<double>(part) / static_cast<double>(whole);
}

}  // namespace

bool is_visible(const TruthPlane& plane, const sim::Bvh& scene, const Eigen::Vector3f& sensor,
                const TruthRules& rules) {
  return std::ranges::any_of(plane.raster(rules.raster_m, rules.margin_m),
                             [&](const Eigen::Vector2d& place) { return sees(scene, sensor, plane.place(place)); });
}

PointTruth assign_points(const scan::PointCloud& cloud, std::span<const TruthPlane> planes,
                         std::span<const TruthPlane> others, const sim::Bvh& scene, const TruthRules& rules) {
  const Eigen::Vector3f sensor = cloud.sensor_origin.value();
  std::vector<bool> visible;
  for (const TruthPlane& plane : planes) visible.push_back(is_visible(plane, scene, sensor, rules));

  PointTruth truth;
  std::vector<std::size_t> counts(planes.size(), 0);
  for (const Eigen::Vector3f& measured : cloud.points) {
    const Eigen::Vector3d point = measured.cast<double>();
    std::uint32_t nearest = kNoPlane;
    double limit = rules.max_distance_m;
    for (std::size_t i = 0; i < planes.size(); ++i) {
      if (!visible[i]) continue;
      if (const auto found = distance(planes[i], point, limit)) {
        limit = *found;
        nearest = static_cast<std::uint32_t>(i);
      }
    }
    if (nearest != kNoPlane) {
      const TruthPlane& plane = planes[nearest];
      const bool is_other =
          std::ranges::any_of(others, [&](const TruthPlane& p) { return distance(p, point, limit).has_value(); });
      if (is_other || !sees(scene, sensor, plane.place(plane.nearest(plane.flatten(point))))) nearest = kNoPlane;
    }
    if (nearest != kNoPlane) ++counts[nearest];
    truth.plane_of.push_back(nearest);
  }
  for (const std::size_t count : counts)
    truth.is_detectable.push_back(count >= static_cast<std::size_t>(rules.min_points));
  for (std::uint32_t& plane : truth.plane_of)
    if (plane != kNoPlane && !truth.is_detectable[plane]) plane = kNoPlane;
  return truth;
}

std::vector<std::uint32_t> match_regions(std::span<const detect::PlaneRegion> regions,
                                         std::span<const Eigen::Vector3f> points, std::span<const TruthPlane> planes,
                                         const std::vector<bool>& is_detectable, const TruthRules& rules) {
  std::vector<std::uint32_t> match_of(regions.size(), kNoPlane);
  std::vector<double> most(regions.size(), 0.0);
  for (std::size_t i = 0; i < planes.size(); ++i) {
    if (!is_detectable[i]) continue;
    const TruthPlane& plane = planes[i];
    const Cells plane_cells = cells_of(plane, rules);
    for (std::size_t k = 0; k < regions.size(); ++k) {
      const detect::PrincipalAxes& axes = regions[k].axes;
      if (std::abs(plane.height(axes.centroid)) >= rules.max_distance_m) continue;
      if (std::abs(plane.normal().dot(axes.normal())) < std::cos(rules.max_angle_rad)) continue;
      const Cells cells = cells_of(regions[k], points, plane, rules);
      const auto both = std::ranges::count_if(cells, [&](const CellIndex& cell) { return plane_cells.contains(cell); });
      const double share = ratio(static_cast<std::size_t>(both), cells.size());
      if (share < rules.min_overlap || share <= most[k]) continue;
      most[k] = share;
      match_of[k] = static_cast<std::uint32_t>(i);
    }
  }
  return match_of;
}

SegmentationMeasures measure(std::span<const detect::PlaneRegion> regions, std::span<const std::uint32_t> match_of,
                             const PointTruth& truth) {
  std::set<std::uint32_t> found;
  std::size_t finding = 0, right = 0, in_finding = 0;
  for (std::size_t i = 0; i < regions.size(); ++i) {
    if (match_of[i] == kNoPlane) continue;
    found.insert(match_of[i]);
    ++finding;
    in_finding += regions[i].points.size();
    for (const std::uint32_t point : regions[i].points) right += truth.plane_of[point] == match_of[i] ? 1 : 0;
  }
  const auto detectable = static_cast<std::size_t>(std::ranges::count(truth.is_detectable, true));
  const auto on_planes = truth.plane_of.size() - static_cast<std::size_t>(std::ranges::count(truth.plane_of, kNoPlane));
  return {.plane_recall = ratio(found.size(), detectable),
          .plane_precision = ratio(found.size(), finding),
          .point_recall = ratio(right, on_planes),
          .point_precision = ratio(right, in_finding)};
}

}  // namespace stairway::evaluation
