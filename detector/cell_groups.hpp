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
  /// Where each cell lies, rising, and at the end one key above all. A step along x adds 1 to a key, one along y or z
  /// `1 << y_shift` or `1 << z_shift`; up to kCellMargin steps from an occupied cell never run into a different row.
  std::vector<std::uint64_t> keys{~std::uint64_t{0}};
  int y_shift = 0;
  int z_shift = 0;

  std::size_t size() const { return starts.size() - 1; }
  std::span<const std::uint32_t> operator[](std::size_t cell) const {
    return std::span(order).subspan(starts[cell], starts[cell + 1] - starts[cell]);
  }
};

inline constexpr int kCellMargin = 4;

/// Groups points by cells of edge `leaf_m` > 0 [m]; points that are not finite or lie farther than 10 km from the
/// origin of their frame belong to no cell. The borders of cells are multiples of `leaf_m`, so cells of half the edge
/// nest in them. Cost: O(N), a radix sort of the cell keys.
CellGroups group_by_cell(std::span<const Eigen::Vector3f> points, double leaf_m);

/// Tells which cells lie around a cell, for all cells in turn.
///
/// Cells in one row along x follow each other in the groups. Since cells are asked for in their order, the beginning
/// of each row around them only ever moves forward, and nothing needs to be searched.
class CellRows {
 public:
  /// @param groups  must outlive this and stay as it is.
  /// @param reach   cells on each side, 1 to kCellMargin.
  CellRows(const CellGroups& groups, int reach);

  /// Calls `visit(first, last)` for every run of cells first .. last - 1 within reach of `cell`, itself included.
  /// @pre `cell` is not less than at the call before.
  template <class Visit>
  void around(std::size_t cell, Visit visit) {
    const std::uint64_t* const keys = groups_->keys.data();
    const std::uint64_t key = keys[cell];
    for (Row& row : rows_) {
      const std::uint64_t low = key + row.offset;
      while (keys[row.first] < low) ++row.first;
      std::size_t last = row.first;
      while (keys[last] <= low + length_) ++last;
      if (last > row.first) visit(row.first, last);
    }
  }

 private:
  struct Row {
    std::uint64_t offset;  // modulo 2^64, to the first key of the row
    std::size_t first;
  };
  const CellGroups* groups_;
  std::uint64_t length_;
  std::vector<Row> rows_;
};

}  // namespace stairway::detect
