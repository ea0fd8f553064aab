// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "detector/cell_moments.hpp"

#include "detector/parallel_ranges.hpp"

namespace stairway::detect {
namespace {

Eigen::Array4f widened(const Eigen::Vector3f& p) { return {p.x(), p.y(), p.z(), 0.0F}; }

CellMoments moments_of(std::span<const Eigen::Vector3f> points, std::span<const std::uint32_t> members) {
  CellMoments cell;
  const Eigen::Vector3f& origin = points[members.front()];
  Eigen::Vector3f sum = Eigen::Vector3f::Zero();
  for (const std::uint32_t point : members) sum += points[point] - origin;
  cell.count = static_cast<float>(members.size());
  cell.mean = widened(origin + sum / cell.count);
  for (const std::uint32_t point : members) {
    const Eigen::Array4f d = widened(points[point]) - cell.mean;
    cell.products.add(d, d);
  }
  return cell;
}

}  // namespace

std::vector<CellMoments> moments_of_cells(std::span<const Eigen::Vector3f> points, const CellGroups& groups,
                                          int threads) {
  constexpr std::size_t kFewest = 2000;
  std::vector<CellMoments> cells(groups.size());
  for_ranges(cells.size(), threads, kFewest, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) cells[i] = moments_of(points, groups[i]);
  });
  return cells;
}

std::vector<CellMoments> merged_moments(std::span<const CellMoments> cells, const CellGroups& groups) {
  std::vector<CellMoments> merged(groups.size());
  for (std::size_t i = 0; i < groups.size(); ++i) {
    NeighbourhoodMoments sum(cells[groups[i].front()].mean);
    for (const std::uint32_t cell : groups[i]) sum.add(cells[cell]);
    merged[i] = sum.as_cell();
  }
  return merged;
}

PrincipalAxes NeighbourhoodMoments::axes() const {
  const double n = count_;
  const Eigen::Vector3d mean = sum_.head<3>().matrix().cast<double>() / n;
  const Eigen::Array4d squares = products_.squares.cast<double>();
  const Eigen::Array4d mixed = products_.mixed.cast<double>();
  Eigen::Matrix3d outer;
  outer << squares[0], mixed[0], mixed[2], mixed[0], squares[1], mixed[1], mixed[2], mixed[1], squares[2];
  return principal_axes(origin_.head<3>().matrix().cast<double>() + mean, outer / n - mean * mean.transpose());
}

CellMoments NeighbourhoodMoments::as_cell() const {
  CellMoments cell;
  const Eigen::Array4f mean = sum_ / count_;
  cell.count = count_;
  cell.mean = origin_ + mean;
  cell.products = products_;
  cell.products.add(mean, -sum_);
  return cell;
}

}  // namespace stairway::detect
