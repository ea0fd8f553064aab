// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "detector/normals.hpp"

#include <cmath>
#include <cstdint>
#include <optional>

#include "detector/cell_groups.hpp"
#include "detector/cell_moments.hpp"
#include "detector/parallel_ranges.hpp"
#include "detector/plane.hpp"

namespace stairway::detect {
namespace {

constexpr int kCellsPerRadius = 2;
constexpr int kMostDoublings = 3;
constexpr std::size_t kFewestCells = 1000;  // for a thread of their own

/// The plane through the surroundings of a cell; nothing when they hold too few points.
class Surroundings {
 public:
  Surroundings(const CellGroups& groups, const std::vector<CellMoments>& cells, double radius_m, int min_neighbours)
      : cells_(cells),
        rows_(groups, kCellsPerRadius),
        squared_radius_(static_cast<float>(radius_m * radius_m)),
        min_neighbours_(static_cast<float>(min_neighbours)) {}

  /// @pre `cell` is not less than at the call before.
  std::optional<PrincipalAxes> plane_at(std::size_t cell) {
    const Eigen::Array4f middle = cells_[cell].mean;
    NeighbourhoodMoments sum(middle);
    rows_.around(cell, [&](std::size_t first, std::size_t last) {
      for (std::size_t other = first; other < last; ++other) {
        const Eigen::Array4f from_middle = cells_[other].mean - middle;
        if (from_middle.matrix().squaredNorm() <= squared_radius_) sum.add(cells_[other], from_middle);
      }
    });
    return sum.count() < min_neighbours_ ? std::nullopt : std::optional(sum.axes());
  }

 private:
  const std::vector<CellMoments>& cells_;
  CellRows rows_;
  float squared_radius_;
  float min_neighbours_;
};

struct Facing {
  Eigen::Vector3f normal = Eigen::Vector3f::UnitZ();
  float variation = 1.0F / 3.0F;
  bool is_known = false;
};

class NormalEstimator {
 public:
  NormalEstimator(const scan::PointCloud& cloud, std::size_t wanted, const NormalOptions& options, int threads)
      : cloud_(cloud),
        options_(options),
        threads_(threads),
        groups_(group_by_cell(cloud.points, options.radius_m / kCellsPerRadius)),
        cells_(moments_of_cells(cloud.points, groups_, threads)),
        facings_(cells_.size()) {
    places_.reserve(cells_.size());
    for (const CellMoments& cell : cells_) places_.push_back(cell.place());
    for (std::size_t i = 0; i < cells_.size(); ++i)
      is_asked_.push_back(groups_[i].front() < wanted);  // points of a cell come in their order
    for_ranges(cells_.size(), threads_, kFewestCells, [&](std::size_t first, std::size_t last) {
      Surroundings surroundings(groups_, cells_, options_.radius_m, options_.min_neighbours);
      for (std::size_t i = first; i < last; ++i)
        if (is_asked_[i]) facings_[i] = facing(surroundings.plane_at(i), places_[i]);
    });
    for (int doubled = 1; doubled <= kMostDoublings; ++doubled) look_farther(std::ldexp(options_.radius_m, doubled));
  }

  SurfaceNormals of_points(std::size_t wanted) const {
    SurfaceNormals result;
    result.normals.assign(wanted, Eigen::Vector3f::UnitZ());
    result.variations.assign(wanted, 1.0F / 3.0F);
    for (std::size_t i = 0; i < cells_.size(); ++i) {
      for (const std::uint32_t point : groups_[i]) {
        if (point >= wanted) break;
        result.normals[point] = facings_[i].normal;
        result.variations[point] = facings_[i].variation;
      }
    }
    return result;
  }

 private:
  Facing facing(const std::optional<PrincipalAxes>& plane, const Eigen::Vector3f& place) const {
    if (!plane) return {};
    Eigen::Vector3f normal = plane->normal().cast<float>();
    if (cloud_.sensor_origin && normal.dot(*cloud_.sensor_origin - place) < 0.0F) normal = -normal;
    return {normal, static_cast<float>(plane->surface_variation()), true};
  }

  bool is_open(std::uint32_t cell) const { return is_asked_[cell] && !facings_[cell].is_known; }

  // For the cells that are without a plane still.
  void look_farther(double radius_m) {
    const CellGroups large = group_by_cell(places_, radius_m / kCellsPerRadius);
    const std::vector<CellMoments> moments = merged_moments(cells_, large);
    for_ranges(large.size(), threads_, kFewestCells, [&](std::size_t first, std::size_t last) {
      Surroundings surroundings(large, moments, radius_m, options_.min_neighbours);
      for (std::size_t i = first; i < last; ++i) {
        std::optional<std::optional<PrincipalAxes>> plane;
        for (const std::uint32_t cell : large[i]) {
          if (!is_open(cell)) continue;
          if (!plane) plane = surroundings.plane_at(i);
          facings_[cell] = facing(*plane, places_[cell]);
        }
      }
    });
  }

  const scan::PointCloud& cloud_;
  const NormalOptions& options_;
  const int threads_;
  const CellGroups groups_;
  const std::vector<CellMoments> cells_;
  std::vector<Eigen::Vector3f> places_;
  std::vector<std::uint8_t> is_asked_;
  std::vector<Facing> facings_;
};

}  // namespace

std::string NormalOptions::problem() const {
  if (!(radius_m > 0.0)) return "radius_m must be greater than 0";
  if (min_neighbours < 3) return "min_neighbours must be at least 3: fewer points make no plane";
  return {};
}

SurfaceNormals estimate_normals(const scan::PointCloud& cloud, const NormalOptions& options) {
  return estimate_normals(cloud, cloud.points.size(), options);
}

SurfaceNormals estimate_normals(const scan::PointCloud& cloud, std::size_t wanted, const NormalOptions& options,
                                int threads) {
  return NormalEstimator(cloud, wanted, options, threads).of_points(wanted);
}

}  // namespace stairway::detect
