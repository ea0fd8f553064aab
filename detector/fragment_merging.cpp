// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "detector/fragment_merging.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "detector/extents.hpp"
#include "detector/part_grid.hpp"

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

Eigen::Vector2d plan(const Eigen::Vector3d& p) { return p.head<2>(); }

// The radius, seen from above, of a circle about the centroid that holds the outline and any box about it.
double reach(const StairPart& part) {
  double farthest = 0.0;
  for (const Eigen::Vector3d* p : {&part.end_a, &part.end_b, &part.front, &part.back})
    farthest = std::max(farthest, plan(*p - part.centroid).norm());
  return std::numbers::sqrt2 * farthest;
}

// Which fragments may be near enough to one to belong to it.
class Neighbourhood {
 public:
  Neighbourhood(const std::vector<std::optional<StairPart>>& fragments, const FragmentMergingOptions& options)
      : numbers_(numbers_of_parts(fragments)),
        grid_(places(fragments, numbers_), kCell_m),
        distance_m_(options.max_offset_m + options.max_gap_m) {
    for (const std::size_t number : numbers_) largest_m_ = std::max(largest_m_, reach(*fragments[number]));
  }

  /// In rising order.
  std::vector<std::size_t> around(const StairPart& part) const {
    std::vector<std::size_t> found;
    grid_.around(plan(part.centroid), reach(part) + largest_m_ + distance_m_, found);
    for (std::size_t& number : found) number = numbers_[number];
    return found;
  }

 private:
  static constexpr double kCell_m = 1.0;

  static std::vector<std::size_t> numbers_of_parts(const std::vector<std::optional<StairPart>>& fragments) {
    std::vector<std::size_t> numbers;
    for (std::size_t i = 0; i < fragments.size(); ++i)
      if (fragments[i]) numbers.push_back(i);
    return numbers;
  }

  static std::vector<Eigen::Vector2d> places(const std::vector<std::optional<StairPart>>& fragments,
                                             const std::vector<std::size_t>& numbers) {
    std::vector<Eigen::Vector2d> result;
    for (const std::size_t number : numbers) result.push_back(plan(fragments[number]->centroid));
    return result;
  }

  std::vector<std::size_t> numbers_;
  PartGrid grid_;
  double distance_m_;
  double largest_m_ = 0.0;
};

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

  const Neighbourhood neighbourhood(parts, options);
  for (std::size_t i = 0; i < regions.size(); ++i) {
    bool grew = parts[i].has_value();
    while (grew) {
      grew = false;
      std::vector<std::size_t> near = neighbourhood.around(*parts[i]);
      for (auto next = std::upper_bound(near.begin(), near.end(), i); next != near.end();) {
        const std::size_t k = *next++;
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
        near = neighbourhood.around(*parts[i]);
        next = std::upper_bound(near.begin(), near.end(), k);
      }
    }
  }
  std::erase_if(regions, [](const PlaneRegion& region) { return region.points.empty(); });
  return regions;
}

}  // namespace stairway::detect
