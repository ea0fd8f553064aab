// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "detector/normals.hpp"

#include <optional>

#include "detector/cell_groups.hpp"
#include "detector/cell_moments.hpp"
#include "detector/cloud_index.hpp"
#include "detector/plane.hpp"

namespace stairway::detect {
namespace {

constexpr int kCellsPerRadius = 3;

// For cells in a sparse place. The tree is built when the first of them comes.
class NearestCells {
 public:
  explicit NearestCells(const std::vector<CellMoments>& cells) : cells_(cells) {}

  NeighbourhoodMoments around(const CellMoments& cell, std::size_t count) {
    if (!index_) {
      for (const CellMoments& each : cells_) means_.push_back(each.place());
      index_.emplace(means_);
    }
    index_->nearest(cell.place(), count, found_);
    NeighbourhoodMoments result(cell.mean);
    for (const std::uint32_t other : found_) result.add(cells_[other]);
    return result;
  }

 private:
  const std::vector<CellMoments>& cells_;
  std::vector<Eigen::Vector3f> means_;
  std::optional<CloudIndex> index_;
  std::vector<std::uint32_t> found_;
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

SurfaceNormals estimate_normals(const scan::PointCloud& cloud, std::size_t wanted, const NormalOptions& options) {
  SurfaceNormals result;
  result.normals.assign(wanted, Eigen::Vector3f::UnitZ());
  result.variations.assign(wanted, 1.0F / 3.0F);

  const CellGroups groups = group_by_cell(cloud.points, options.radius_m / kCellsPerRadius);
  const std::vector<CellMoments> cells = moments_of_cells(cloud.points, groups);
  NearestCells nearest(cells);
  CellRows rows(groups, kCellsPerRadius);
  const auto squared_radius = static_cast<float>(options.radius_m * options.radius_m);
  for (std::size_t i = 0; i < cells.size(); ++i) {
    if (groups[i].front() >= wanted) continue;  // points of a cell come in their order
    const Eigen::Array4f middle = cells[i].mean;
    NeighbourhoodMoments neighbourhood(middle);
    rows.around(i, [&](std::size_t first, std::size_t last) {
      for (std::size_t other = first; other < last; ++other) {
        const Eigen::Array4f from_middle = cells[other].mean - middle;
        if (from_middle.matrix().squaredNorm() <= squared_radius) neighbourhood.add(cells[other], from_middle);
      }
    });
    if (neighbourhood.count() < static_cast<float>(options.min_neighbours))
      neighbourhood = nearest.around(cells[i], static_cast<std::size_t>(options.min_neighbours));
    if (neighbourhood.count() < 3.0F) continue;
    const PrincipalAxes axes = neighbourhood.axes();
    Eigen::Vector3f normal = axes.normal().cast<float>();
    if (cloud.sensor_origin && normal.dot(*cloud.sensor_origin - cells[i].place()) < 0.0F) normal = -normal;
    for (const std::uint32_t point : groups[i]) {
      if (point >= wanted) break;
      result.normals[point] = normal;
      result.variations[point] = static_cast<float>(axes.surface_variation());
    }
  }
  return result;
}

}  // namespace stairway::detect
