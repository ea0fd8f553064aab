// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "detector/fragment_merging.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "detector/extents.hpp"

namespace stairway::detect {
namespace {

double gap(const Interval& a, const Interval& b) { return std::max(-overlap(a, b), 0.0); }

Interval between(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& axis) {
  return {std::min(a.dot(axis), b.dot(axis)), std::max(a.dot(axis), b.dot(axis))};
}

// The other part's outline is taken for an axis-aligned box in the axes of `self`: near enough for fragments that are
// nearly parallel anyway.
double gap_along(const StairPart& self, const StairPart& other, const Eigen::Vector3d& axis) {
  const auto extent = [&](const StairPart& part) {
    const Interval length = between(part.end_a, part.end_b, axis);
    const Interval depth = between(part.front, part.back, axis);
    return Interval{std::min(length.low, depth.low), std::max(length.high, depth.high)};
  };
  return gap(extent(self), extent(other));
}

bool belong_together(const StairPart& a, const StairPart& b, const FragmentMergingOptions& options) {
  if (a.kind != b.kind) return false;
  const StairPart& larger = a.point_count >= b.point_count ? a : b;
  const StairPart& smaller = a.point_count >= b.point_count ? b : a;
  const Eigen::Vector3d across = Eigen::Vector3d::UnitZ().cross(larger.facing);
  if (a.kind == StairPart::Kind::Tread) {
    return std::abs(a.centroid.z() - b.centroid.z()) < options.max_offset_m &&
           std::hypot(gap_along(larger, smaller, across), gap_along(larger, smaller, larger.facing)) <
               options.max_gap_m;
  }
  return std::abs((a.centroid - b.centroid).dot(larger.facing)) < options.max_offset_m &&
         std::abs(a.facing.dot(b.facing)) > std::cos(options.max_riser_angle_rad) &&
         std::hypot(gap_along(larger, smaller, across), gap({a.bottom.z(), a.top.z()}, {b.bottom.z(), b.top.z()})) <
             options.max_gap_m;
}

}  // namespace

std::string FragmentMergingOptions::problem() const {
  if (!(max_offset_m > 0.0)) return "max_offset_m must be greater than 0";
  if (!(max_gap_m >= 0.0)) return "max_gap_m must not be negative";
  if (!(max_riser_angle_rad > 0.0)) return "max_riser_angle must be greater than 0";
  return {};
}

std::vector<PlaneRegion> merge_fragments(const scan::PointCloud& cloud, std::vector<PlaneRegion> regions,
                                         const PlaneFinderOptions& plane_finder,
                                         const FragmentMergingOptions& options) {
  if (!options.enabled) return regions;
  PlaneFinderOptions any_width = plane_finder;
  any_width.min_width_m = 0.0;

  std::vector<std::optional<StairPart>> parts;
  parts.reserve(regions.size());
  for (const PlaneRegion& region : regions) parts.push_back(find_stair_part(cloud, region, any_width));

  for (std::size_t i = 0; i < regions.size(); ++i) {
    bool grew = parts[i].has_value();
    while (grew) {
      grew = false;
      for (std::size_t k = i + 1; k < regions.size(); ++k) {
        if (!parts[k] || !belong_together(*parts[i], *parts[k], options)) continue;
        std::vector<std::uint32_t> points = regions[i].points;
        points.insert(points.end(), regions[k].points.begin(), regions[k].points.end());
        PlaneRegion joined = make_region(cloud.points, std::move(points), regions[i].axes.normal());
        std::optional<StairPart> part = find_stair_part(cloud, joined, any_width);
        if (!part || part->kind != parts[i]->kind) continue;
        regions[i] = std::move(joined);
        parts[i] = part;
        parts[k].reset();
        regions[k].points.clear();
        grew = true;
      }
    }
  }
  std::erase_if(regions, [](const PlaneRegion& region) { return region.points.empty(); });
  return regions;
}

}  // namespace stairway::detect
