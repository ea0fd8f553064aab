// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "detector/normals.hpp"

#include <optional>
#include <span>

#include "detector/cell_groups.hpp"
#include "detector/cloud_index.hpp"
#include "detector/plane.hpp"

namespace stairway::detect {
namespace {

constexpr int kCellsPerRadius = 3;

// Sums over points: the fourth numbers are idle, they let the compiler work on all coordinates at once.
struct Products {
  Eigen::Array4f squares = Eigen::Array4f::Zero();  // xx, yy, zz
  Eigen::Array4f mixed = Eigen::Array4f::Zero();    // xy, yz, zx

  void add(const Eigen::Array4f& d, const Eigen::Array4f& weighted) {
    squares += weighted * d;
    mixed += weighted * Eigen::Array4f(d[1], d[2], d[0], 0.0F);
  }
};

// What the points of one cell add to the moments of a neighbourhood: their mean and the products about it.
struct CellMoments {
  Eigen::Array4f mean;
  Products products;
  float count;

  Eigen::Vector3f place() const { return mean.head<3>().matrix(); }
};

Eigen::Array4f widened(const Eigen::Vector3f& p) { return {p.x(), p.y(), p.z(), 0.0F}; }

std::vector<CellMoments> sum_up(std::span<const Eigen::Vector3f> points, const CellGroups& groups) {
  std::vector<CellMoments> cells(groups.size());
  for (std::size_t i = 0; i < groups.size(); ++i) {
    CellMoments& cell = cells[i];
    const Eigen::Vector3f& origin = points[groups[i].front()];
    Eigen::Vector3f sum = Eigen::Vector3f::Zero();
    for (const std::uint32_t point : groups[i]) sum += points[point] - origin;
    cell.count = static_cast<float>(groups[i].size());
    cell.mean = widened(origin + sum / cell.count);
    for (const std::uint32_t point : groups[i]) {
      const Eigen::Array4f d = widened(points[point]) - cell.mean;
      cell.products.add(d, d);
    }
  }
  return cells;
}

// Moments of several cells about a point among them; single precision is enough for so small a neighbourhood.
class Neighbourhood {
 public:
  explicit Neighbourhood(const Eigen::Array4f& origin) : origin_(origin) {}

  float count() const { return count_; }

  void add(const CellMoments& cell, const Eigen::Array4f& from_origin) {
    const Eigen::Array4f weighted = cell.count * from_origin;
    count_ += cell.count;
    sum_ += weighted;
    products_.squares += cell.products.squares;
    products_.mixed += cell.products.mixed;
    products_.add(from_origin, weighted);
  }

  PrincipalAxes axes() const {
    const double n = count_;
    const Eigen::Vector3d mean = sum_.head<3>().matrix().cast<double>() / n;
    const Eigen::Array4d squares = products_.squares.cast<double>();
    const Eigen::Array4d mixed = products_.mixed.cast<double>();
    Eigen::Matrix3d outer;
    outer << squares[0], mixed[0], mixed[2], mixed[0], squares[1], mixed[1], mixed[2], mixed[1], squares[2];
    return principal_axes(origin_.head<3>().matrix().cast<double>() + mean, outer / n - mean * mean.transpose());
  }

 private:
  Eigen::Array4f origin_;
  float count_ = 0.0F;
  Eigen::Array4f sum_ = Eigen::Array4f::Zero();
  Products products_;
};

// For cells in a sparse place. The tree is built when the first of them comes.
class NearestCells {
 public:
  explicit NearestCells(const std::vector<CellMoments>& cells) : cells_(cells) {}

  Neighbourhood around(const CellMoments& cell, std::size_t count) {
    if (!index_) {
      for (const CellMoments& each : cells_) means_.push_back(each.place());
      index_.emplace(means_);
    }
    index_->nearest(cell.place(), count, found_);
    Neighbourhood result(cell.mean);
    for (const std::uint32_t other : found_) result.add(cells_[other], cells_[other].mean - cell.mean);
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
  SurfaceNormals result;
  result.normals.assign(cloud.points.size(), Eigen::Vector3f::UnitZ());
  result.variations.assign(cloud.points.size(), 1.0F / 3.0F);

  const CellGroups groups = group_by_cell(cloud.points, options.radius_m / kCellsPerRadius);
  const std::vector<CellMoments> cells = sum_up(cloud.points, groups);
  NearestCells nearest(cells);
  CellRows rows(groups, kCellsPerRadius);
  const auto squared_radius = static_cast<float>(options.radius_m * options.radius_m);
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const Eigen::Array4f middle = cells[i].mean;
    Neighbourhood neighbourhood(middle);
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
      result.normals[point] = normal;
      result.variations[point] = static_cast<float>(axes.surface_variation());
    }
  }
  return result;
}

}  // namespace stairway::detect
