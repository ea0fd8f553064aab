// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "detector/cell_groups.hpp"
#include "detector/plane.hpp"

namespace stairway::detect {

/// Products of coordinates: the fourth numbers are idle, they let the compiler work on all coordinates at once.
struct CoordinateProducts {
  Eigen::Array4f squares = Eigen::Array4f::Zero();  ///< xx, yy, zz
  Eigen::Array4f mixed = Eigen::Array4f::Zero();    ///< xy, yz, zx

  void add(const Eigen::Array4f& d, const Eigen::Array4f& weighted) {
    squares += weighted * d;
    mixed += weighted * Eigen::Array4f(d[1], d[2], d[0], 0.0F);
  }
};

/// What the points of one cell add to the moments of a neighbourhood: their mean and the products about it [m, m^2].
struct CellMoments {
  Eigen::Array4f mean = Eigen::Array4f::Zero();
  CoordinateProducts products;
  float count = 0.0F;

  Eigen::Vector3f place() const { return mean.head<3>().matrix(); }
};

/// The moments of every cell, in the order of the cells. Cost: O(N).
std::vector<CellMoments> moments_of_cells(std::span<const Eigen::Vector3f> points, const CellGroups& groups,
                                          int threads = 1);
/// Likewise of groups of cells.
std::vector<CellMoments> merged_moments(std::span<const CellMoments> cells, const CellGroups& groups);

/// Moments of several cells about a place among them; single precision is enough for neighbourhoods of a metre.
class NeighbourhoodMoments {
 public:
  explicit NeighbourhoodMoments(const Eigen::Array4f& origin) : origin_(origin) {}

  float count() const { return count_; }

  void add(const CellMoments& cell) { add(cell, cell.mean - origin_); }
  /// @param from_origin  of the cell's mean.
  void add(const CellMoments& cell, const Eigen::Array4f& from_origin) {
    const Eigen::Array4f weighted = cell.count * from_origin;
    count_ += cell.count;
    sum_ += weighted;
    products_.squares += cell.products.squares;
    products_.mixed += cell.products.mixed;
    products_.add(from_origin, weighted);
  }

  /// @pre count() > 0
  PrincipalAxes axes() const;
  /// All of them as one cell. @pre count() > 0
  CellMoments as_cell() const;

 private:
  Eigen::Array4f origin_;
  float count_ = 0.0F;
  Eigen::Array4f sum_ = Eigen::Array4f::Zero();
  CoordinateProducts products_;
};

}  // namespace stairway::detect
