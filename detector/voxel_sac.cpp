// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "detector/voxel_sac.hpp"

#include <Eigen/Geometry>
#include <cmath>
#include <cstdint>
#include <optional>
#include <random>
#include <utility>

#include "detector/cell_groups.hpp"

namespace stairway::detect {
namespace {

struct Plane {
  Eigen::Vector3f center;
  Eigen::Vector3f normal;
};

std::optional<Plane> plane_through(const Eigen::Vector3f& a, const Eigen::Vector3f& b, const Eigen::Vector3f& c) {
  const Eigen::Vector3f normal = (b - a).cross(c - a);
  const float length = normal.norm();
  if (!(length > 0.0F)) return std::nullopt;
  return Plane{a, normal / length};
}

// The cells of one size and which of them touch.
struct Grid {
  CellGroups cells;
  std::vector<std::pair<std::size_t, std::size_t>> runs;  // of adjacent cells, first .. last - 1
  std::vector<std::size_t> starts{0};                     // of each cell, in runs

  Grid(std::span<const Eigen::Vector3f> points, double leaf_m) : cells(group_by_cell(points, leaf_m)) {
    CellRows rows(cells, 1);
    for (std::size_t cell = 0; cell < cells.size(); ++cell) {
      rows.around(cell, [&](std::size_t first, std::size_t last) { runs.emplace_back(first, last); });
      starts.push_back(runs.size());
    }
  }

  template <class Visit>
  void for_each_adjacent(std::size_t cell, Visit visit) const {
    for (std::size_t run = starts[cell]; run < starts[cell + 1]; ++run)
      for (std::size_t other = runs[run].first; other < runs[run].second; ++other) visit(other);
  }
};

// Finds the regions of one cell size among the points that are left.
class Level {
 public:
  Level(const scan::PointCloud& cloud, const SurfaceNormals& surface, const VoxelSacOptions& options,
        std::vector<std::uint32_t>& left, double leaf_m)
      : cloud_(cloud),
        surface_(surface),
        options_(options),
        left_(left),
        max_distance_(static_cast<float>(options.max_plane_distance_m)),
        min_cosine_(static_cast<float>(std::cos(options.max_normal_angle_rad))),
        grid_(places(), leaf_m),
        is_taken_(left.size(), false),
        listed_for_(grid_.cells.size(), 0) {}

  void find_regions(std::vector<PlaneRegion>& regions) {
    for (std::size_t cell = 0; cell < grid_.cells.size(); ++cell) {
      const std::optional<Plane> plane = find_plane(cell);
      if (!plane) continue;
      spread(*plane, cell);
      if (region_.size() > static_cast<std::size_t>(options_.min_points)) {
        std::vector<std::uint32_t> points;
        for (const std::uint32_t i : region_) points.push_back(left_[i]);
        regions.push_back(make_region(cloud_, std::move(points)));
      } else {
        for (const std::uint32_t i : region_) is_taken_[i] = false;
      }
    }
    std::vector<std::uint32_t> rest;
    for (std::size_t i = 0; i < left_.size(); ++i)
      if (!is_taken_[i]) rest.push_back(left_[i]);
    left_ = std::move(rest);
  }

 private:
  std::vector<Eigen::Vector3f> places() const {
    std::vector<Eigen::Vector3f> result;
    result.reserve(left_.size());
    for (const std::uint32_t point : left_) result.push_back(cloud_.points[point]);
    return result;
  }

  bool complies(const Plane& plane, std::uint32_t i) const {
    const std::uint32_t point = left_[i];
    return std::abs((cloud_.points[point] - plane.center).dot(plane.normal)) < max_distance_ &&  // eq 1
           std::abs(surface_.normals[point].dot(plane.normal)) > min_cosine_;
  }

  // RANSAC in one cell.
  std::optional<Plane> find_plane(std::size_t cell) {
    free_.clear();
    for (const std::uint32_t i : grid_.cells[cell])
      if (!is_taken_[i]) free_.push_back(i);
    if (free_.size() < 3) return std::nullopt;
    std::minstd_rand random(static_cast<std::uint32_t>(cell * 2654435761U + 1U));
    const auto pick = [&]() -> const Eigen::Vector3f& { return cloud_.points[left_[free_[random() % free_.size()]]]; };
    std::optional<Plane> best;
    auto most = static_cast<std::size_t>(std::ceil(options_.min_inlier_share * static_cast<double>(free_.size())));
    for (int attempt = 0; attempt < options_.iterations && most <= free_.size(); ++attempt) {
      const Eigen::Vector3f& a = pick();
      const Eigen::Vector3f& b = pick();
      const std::optional<Plane> plane = plane_through(a, b, pick());
      if (!plane) continue;
      const std::size_t inliers = count_inliers(*plane, most);
      if (inliers < most) continue;
      most = inliers + 1;
      best = plane;
    }
    return best;
  }

  // Stops counting when `wanted` is out of reach.
  std::size_t count_inliers(const Plane& plane, std::size_t wanted) const {
    std::size_t misses_left = free_.size() - wanted + 1;
    for (const std::uint32_t i : free_)
      if (!complies(plane, i) && --misses_left == 0) return 0;
    return wanted + misses_left - 1;
  }

  // Alg. 3, function SAC PROCESS, beginning with the cell of the plane itself.
  void spread(Plane plane, std::size_t start) {
    region_.clear();
    ++region_number_;
    PointMoments moments(plane.center.cast<double>());
    waiting_.assign(1, start);
    listed_for_[start] = region_number_;
    for (std::size_t next = 0; next < waiting_.size(); ++next) {
      const std::size_t before = region_.size();
      for (const std::uint32_t i : grid_.cells[waiting_[next]]) {
        if (is_taken_[i] || !complies(plane, i)) continue;
        is_taken_[i] = true;
        region_.push_back(i);
        moments.add(cloud_.points[left_[i]]);
      }
      if (region_.size() - before < static_cast<std::size_t>(options_.min_cell_points)) continue;
      const PrincipalAxes axes = principal_axes(moments);
      if (region_.size() >= 3) plane = {axes.centroid.cast<float>(), axes.normal().cast<float>()};
      grid_.for_each_adjacent(waiting_[next], [&](std::size_t cell) {
        if (std::exchange(listed_for_[cell], region_number_) != region_number_) waiting_.push_back(cell);
      });
    }
  }

  const scan::PointCloud& cloud_;
  const SurfaceNormals& surface_;
  const VoxelSacOptions& options_;
  std::vector<std::uint32_t>& left_;  // points of the cloud; all other indices here are into this
  const float max_distance_;
  const float min_cosine_;
  const Grid grid_;
  std::vector<bool> is_taken_;
  std::vector<std::uint32_t> listed_for_;  // by cell
  std::uint32_t region_number_ = 0;
  std::vector<std::uint32_t> free_;
  std::vector<std::uint32_t> region_;
  std::vector<std::size_t> waiting_;
};

}  // namespace

std::string VoxelSacOptions::problem() const {
  if (!(min_leaf_m > 0.0)) return "voxel_sac.min_leaf_m must be greater than 0";
  if (!(max_leaf_m >= min_leaf_m && max_leaf_m <= 1000.0 * min_leaf_m))
    return "voxel_sac.max_leaf_m must lie between min_leaf_m and 1000 times that";
  if (iterations < 1) return "voxel_sac.iterations must be at least 1";
  if (!(min_inlier_share > 0.0 && min_inlier_share <= 1.0))
    return "voxel_sac.min_inlier_share must be greater than 0 and at most 1";
  if (!(max_plane_distance_m > 0.0)) return "voxel_sac.max_plane_distance_m must be greater than 0";
  if (!(max_normal_angle_rad > 0.0 && max_normal_angle_rad < std::numbers::pi / 2))
    return "voxel_sac.max_normal_angle must lie between 0 and 90 degrees";
  if (min_cell_points < 1) return "voxel_sac.min_cell_points must be at least 1";
  if (min_points < 3) return "voxel_sac.min_points must be at least 3";
  return {};
}

std::vector<PlaneRegion> voxel_sac(const scan::PointCloud& cloud, const SurfaceNormals& surface,
                                   const VoxelSacOptions& options) {
  std::vector<std::uint32_t> left(cloud.points.size());
  for (std::size_t i = 0; i < left.size(); ++i) left[i] = static_cast<std::uint32_t>(i);
  std::vector<PlaneRegion> regions;
  const int levels = 1 + static_cast<int>(std::log2(options.max_leaf_m / options.min_leaf_m) + 1e-9);
  for (int level = levels - 1; level >= 0; --level)
    Level(cloud, surface, options, left, std::ldexp(options.min_leaf_m, level)).find_regions(regions);
  return regions;
}

}  // namespace stairway::detect
