// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "detector/planar_patches.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "detector/cell_groups.hpp"
#include "detector/cell_moments.hpp"
#include "detector/ghost_filter.hpp"
#include "detector/parallel_ranges.hpp"
#include "detector/voxel_grid.hpp"

namespace stairway::detect {
namespace {

// The points of an L, as where tread and riser meet, scatter a quarter as much across it as along it.
constexpr double kFlat = 4.0;
constexpr double kFilled = 0.6;            // of the variance of a square as wide as the cell
constexpr double kStray = 2.5;             // thicknesses
constexpr double kMostStrays = 0.02;       // of the points
constexpr std::size_t kFewestCells = 500;  // for a thread of their own

enum class CellUse : std::uint8_t { Patch, Halo, Loose };

class ElementBuilder {
 public:
  ElementBuilder(const scan::PointCloud& cloud, const PatchOptions& options, int threads)
      : cloud_(cloud),
        options_(options),
        threads_(threads),
        cells_(group_by_cell(cloud.points, 0.5 * options.edge_m)),
        moments_(moments_of_cells(cloud.points, cells_, threads)),
        use_(cells_.size(), CellUse::Loose) {
    elements_.cloud.sensor_origin = cloud.sensor_origin;
  }

  void find_patches(double voxel_m) {
    add_patches(voxel_m);
    add_points(voxel_m);
  }

  SurfaceElements with_normals(const NormalOptions& options) {
    const SurfaceNormals surface = estimate_normals(loose_, loose_count_, options, threads_);
    SurfaceNormals& all = elements_.surface;
    all.normals.insert(all.normals.end(), surface.normals.begin(), surface.normals.end());
    all.variations.insert(all.variations.end(), surface.variations.begin(), surface.variations.end());
    return std::move(elements_);
  }

 private:
  // Points that fill most of the cell's cross section and lie, but for strays, on one plane.
  std::optional<PrincipalAxes> plane_of(std::span<const std::uint32_t> cells) const {
    NeighbourhoodMoments sum(moments_[cells.front()].mean);
    for (const std::uint32_t cell : cells) sum.add(moments_[cell]);
    if (!(sum.count() > static_cast<float>(options_.min_points))) return std::nullopt;
    const PrincipalAxes axes = sum.axes();
    const double thickness = axes.variances[2];
    if (thickness > options_.max_thickness_m * options_.max_thickness_m || axes.variances[1] < kFlat * thickness ||
        axes.variances[1] < kFilled * options_.edge_m * options_.edge_m / 12.0 || may_be_ghosts(axes) ||
        strays(cells, axes) > kMostStrays * static_cast<double>(sum.count()))
      return std::nullopt;
    return axes;
  }

  // Ghosts between two surfaces line up to a slope that is seen from nearly within.
  bool may_be_ghosts(const PrincipalAxes& plane) const {
    constexpr double kUpright = 0.2;
    constexpr double kLevel = 0.97;
    constexpr double kGrazing = 0.42;  // 25 degrees
    if (!cloud_.sensor_origin) return false;
    const double upward = std::abs(plane.normal().z());
    const Eigen::Vector3d sight = (plane.centroid - cloud_.sensor_origin->cast<double>()).normalized();
    return upward > kUpright && upward < kLevel && std::abs(sight.dot(plane.normal())) < kGrazing;
  }

  double strays(std::span<const std::uint32_t> cells, const PrincipalAxes& plane) const {
    const Eigen::Vector3f normal = plane.normal().cast<float>();
    const Eigen::Vector3f place = plane.centroid.cast<float>();
    const auto far = static_cast<float>(kStray * options_.max_thickness_m);
    double count = 0.0;
    for (const std::uint32_t cell : cells)
      for (const std::uint32_t point : cells_[cell])
        count += std::abs(normal.dot(cloud_.points[point] - place)) > far ? 1.0 : 0.0;
    return count;
  }

  void add_patches(double voxel_m) {
    const double most_voxels = std::pow(options_.edge_m / voxel_m, 2);
    std::vector<Eigen::Vector3f> places;
    places.reserve(moments_.size());
    for (const CellMoments& cell : moments_) places.push_back(cell.place());
    const CellGroups large = group_by_cell(places, options_.edge_m);
    std::vector<std::optional<PrincipalAxes>> planes(large.size());
    for_ranges(large.size(), threads_, kFewestCells, [&](std::size_t first, std::size_t last) {
      for (std::size_t i = first; i < last; ++i) planes[i] = plane_of(large[i]);
    });
    CellRows rows(large, 1);
    for (std::size_t i = 0; i < large.size(); ++i)
      if (planes[i] && goes_on_around(i, planes, rows)) add_patch(*planes[i], large[i], most_voxels);
  }

  // A facet of a column has neighbours above and below, the front of a step to both sides.
  static bool goes_on_around(std::size_t cell, const std::vector<std::optional<PrincipalAxes>>& planes,
                             CellRows& rows) {
    constexpr int kFewest = 3;
    constexpr double kParallel = 0.985;  // 10 degrees
    constexpr double kInPlane_m = 0.02;
    const PrincipalAxes& own = *planes[cell];
    int count = 0;
    rows.around(cell, [&](std::size_t first, std::size_t last) {
      for (std::size_t other = first; other < last; ++other) {
        if (other == cell || !planes[other]) continue;
        const PrincipalAxes& axes = *planes[other];
        count += std::abs(axes.normal().dot(own.normal())) > kParallel &&
                 std::abs((axes.centroid - own.centroid).dot(own.normal())) < kInPlane_m;
      }
    });
    return count >= kFewest;
  }

  void add_patch(const PrincipalAxes& plane, std::span<const std::uint32_t> cells, double most_voxels) {
    const std::size_t before = elements_.members.size();
    for (const std::uint32_t cell : cells) {
      use_[cell] = CellUse::Patch;
      elements_.members.insert(elements_.members.end(), cells_[cell].begin(), cells_[cell].end());
    }
    const auto count = static_cast<double>(elements_.members.size() - before);
    Eigen::Vector3f normal = plane.normal().cast<float>();
    const Eigen::Vector3f place = plane.centroid.cast<float>();
    if (cloud_.sensor_origin && normal.dot(*cloud_.sensor_origin - place) < 0.0F) normal = -normal;
    close_element(place, static_cast<std::uint32_t>(std::min(count, std::max(1.0, most_voxels))));
    elements_.surface.normals.push_back(normal);
    elements_.surface.variations.push_back(static_cast<float>(plane.surface_variation()));
  }

  void close_element(const Eigen::Vector3f& place, std::uint32_t weight) {
    elements_.cloud.points.push_back(place);
    elements_.weights.push_back(weight);
    const std::uint32_t first = elements_.runs.empty() ? 0 : elements_.runs.back().last;
    elements_.runs.push_back({first, static_cast<std::uint32_t>(elements_.members.size())});
  }

  // What lies in patches around loose points helps to tell their normals.
  void add_points(double voxel_m) {
    const std::vector<std::uint32_t> points = points_used_as(CellUse::Loose);
    const scan::PointCloud loose{.points = picked(points), .sensor_origin = cloud_.sensor_origin};
    const CellGroups voxels = group_by_cell(loose.points, voxel_m);
    loose_ = centroids(loose, voxels);
    loose_count_ = voxels.size();
    for (std::size_t i = 0; i < voxels.size(); ++i) {
      for (const std::uint32_t point : voxels[i]) elements_.members.push_back(points[point]);
      close_element(loose_.points[i], 1);
    }
    mark_halo();
    const std::vector<Eigen::Vector3f> halo = picked(points_used_as(CellUse::Halo));
    loose_.points.insert(loose_.points.end(), halo.begin(), halo.end());
  }

  void mark_halo() {
    CellRows rows(cells_, 1);
    for (std::size_t i = 0; i < cells_.size(); ++i) {
      bool is_near = false;
      rows.around(i, [&](std::size_t first, std::size_t last) {
        for (std::size_t k = first; k < last; ++k) is_near = is_near || use_[k] == CellUse::Loose;
      });
      if (is_near && use_[i] == CellUse::Patch) use_[i] = CellUse::Halo;
    }
  }

  std::vector<std::uint32_t> points_used_as(CellUse use) const {
    std::vector<std::uint32_t> points;
    for (std::size_t i = 0; i < cells_.size(); ++i)
      if (use_[i] == use) points.insert(points.end(), cells_[i].begin(), cells_[i].end());
    return points;
  }

  std::vector<Eigen::Vector3f> picked(const std::vector<std::uint32_t>& points) const {
    std::vector<Eigen::Vector3f> result;
    result.reserve(points.size());
    for (const std::uint32_t point : points) result.push_back(cloud_.points[point]);
    return result;
  }

  const scan::PointCloud& cloud_;
  const PatchOptions& options_;
  const int threads_;
  const CellGroups cells_;
  const std::vector<CellMoments> moments_;
  std::vector<CellUse> use_;
  SurfaceElements elements_;
  scan::PointCloud loose_;  // thinned, and the points around them
  std::size_t loose_count_ = 0;
};

}  // namespace

std::string PatchOptions::problem() const {
  if (!(edge_m > 0.0)) return "edge_m must be greater than 0";
  if (min_points < 3) return "min_points must be at least 3";
  if (!(max_thickness_m > 0.0)) return "max_thickness_m must be greater than 0";
  return {};
}

void SurfaceElements::drop_ghosts(double min_grazing_rad) {
  const std::vector<std::uint32_t> kept = detect::drop_ghosts(cloud, surface, min_grazing_rad);
  for (std::size_t i = 0; i < kept.size(); ++i) {
    weights[i] = weights[kept[i]];
    runs[i] = runs[kept[i]];
  }
  weights.resize(kept.size());
  runs.resize(kept.size());
}

SurfaceElements surface_elements(const scan::PointCloud& cloud, double voxel_m, const NormalOptions& normals,
                                 const PatchOptions& options, const StageListener& on_stage, int threads) {
  begin_stage(on_stage, "voxel_grid");
  ElementBuilder builder(cloud, options, threads);
  builder.find_patches(voxel_m);
  begin_stage(on_stage, "normals");
  return builder.with_normals(normals);
}

std::vector<PlaneRegion> grow_regions(const scan::PointCloud& cloud, const SurfaceElements& elements,
                                      const RegionGrowingOptions& options, int threads) {
  constexpr std::size_t kFewestSets = 10;
  const std::vector<std::vector<std::uint32_t>> sets =
      grow_point_sets(elements.cloud, elements.surface, elements.weights, options);
  const auto region_of = [&](const std::vector<std::uint32_t>& set) {
    std::vector<std::uint32_t> points;
    for (const std::uint32_t element : set)
      points.insert(points.end(), elements.members.begin() + elements.runs[element].first,
                    elements.members.begin() + elements.runs[element].last);
    return make_region(cloud.points, std::move(points), elements.surface.normals[set.front()].cast<double>());
  };
  std::vector<PlaneRegion> regions(sets.size());
  for_ranges(sets.size(), threads, kFewestSets, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) regions[i] = region_of(sets[i]);
  });
  return regions;
}

}  // namespace stairway::detect
