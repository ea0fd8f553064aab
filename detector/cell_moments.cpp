// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "detector/cell_moments.hpp"

namespace stairway::detect {
namespace {

Eigen::Array4f widened(const Eigen::Vector3f& p) { return {p.x(), p.y(), p.z(), 0.0F}; }

}  // namespace

std::vector<CellMoments> moments_of_cells(std::span<const Eigen::Vector3f> points, const CellGroups& groups) {
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

PrincipalAxes NeighbourhoodMoments::axes() const {
  const double n = count_;
  const Eigen::Vector3d mean = sum_.head<3>().matrix().cast<double>() / n;
  const Eigen::Array4d squares = products_.squares.cast<double>();
  const Eigen::Array4d mixed = products_.mixed.cast<double>();
  Eigen::Matrix3d outer;
  outer << squares[0], mixed[0], mixed[2], mixed[0], squares[1], mixed[1], mixed[2], mixed[1], squares[2];
  return principal_axes(origin_.head<3>().matrix().cast<double>() + mean, outer / n - mean * mean.transpose());
}

}  // namespace stairway::detect
