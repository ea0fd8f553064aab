// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

namespace stairway::detect {

/// Points sorted into cubic cells: cell i holds the points `order[starts[i]] .. order[starts[i + 1] - 1]`.
/// Cells are ordered by place, so they do not depend on the order of the points; within a cell points keep theirs.
struct CellGroups {
  std::vector<std::uint32_t> order;
  std::vector<std::uint32_t> starts{0};

  std::size_t size() const { return starts.size() - 1; }
  std::span<const std::uint32_t> operator[](std::size_t cell) const {
    return std::span(order).subspan(starts[cell], starts[cell + 1] - starts[cell]);
  }
};

/// Groups points by cells of edge `leaf_m` > 0 [m]; points that are not finite or lie farther than 10 km from the
/// origin of their frame belong to no cell. Cost: O(N), a radix sort of the cell keys.
CellGroups group_by_cell(std::span<const Eigen::Vector3f> points, double leaf_m);

}  // namespace stairway::detect
