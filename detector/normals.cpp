// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "detector/normals.hpp"

#include "detector/cell_groups.hpp"
#include "detector/cloud_index.hpp"
#include "detector/plane.hpp"

namespace stairway::detect {
namespace {

constexpr double kCellsPerRadius = 3.0;

std::size_t total_count(const std::vector<PointMoments>& cells, const std::vector<std::uint32_t>& chosen) {
  std::size_t count = 0;
  for (const std::uint32_t cell : chosen) count += cells[cell].count();
  return count;
}

}  // namespace

std::string NormalOptions::problem() const {
  if (!(radius_m > 0.0)) return "radius_m must be greater than 0";
  if (min_neighbours < 3) return "min_neighbours must be at least 3: fewer points make no plane";
  return {};
}

SurfaceNormals estimate_normals(const scan::PointCloud& cloud, const NormalOptions& options) {
  SurfaceNormals result;
  result.normals.assign(cloud.points.size(), Eigen::Vector3f::UnitZ());
  result.variations.assign(cloud.points.size(), 1.0F / 3.0F);

  const CellGroups groups = group_by_cell(cloud.points, options.radius_m / kCellsPerRadius);
  std::vector<PointMoments> cells;
  std::vector<Eigen::Vector3f> means;
  cells.reserve(groups.size());
  means.reserve(groups.size());
  for (std::size_t i = 0; i < groups.size(); ++i) {
    PointMoments& moments = cells.emplace_back(cloud.points[groups[i].front()].cast<double>());
    for (const std::uint32_t point : groups[i]) moments.add(cloud.points[point]);
    means.push_back(moments.mean().cast<float>());
  }
  if (cells.empty()) return result;

  const CloudIndex index(means);
  const auto wanted = static_cast<std::size_t>(options.min_neighbours);
  std::vector<std::uint32_t> neighbours;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    index.within(means[i], options.radius_m, neighbours);
    if (total_count(cells, neighbours) < wanted) index.nearest(means[i], wanted, neighbours);
    PointMoments neighbourhood(means[i].cast<double>());
    for (const std::uint32_t cell : neighbours) neighbourhood.add(cells[cell]);
    const PrincipalAxes axes = principal_axes(neighbourhood);
    Eigen::Vector3f normal = axes.normal().cast<float>();
    if (cloud.sensor_origin && normal.dot(*cloud.sensor_origin - means[i]) < 0.0F) normal = -normal;
    for (const std::uint32_t point : groups[i]) {
      result.normals[point] = normal;
      result.variations[point] = static_cast<float>(axes.surface_variation());
    }
  }
  return result;
}

}  // namespace stairway::detect
