// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

namespace stairway::detect {

/// For every point of a cloud its surroundings: the smallest block of 3 x 3 x 3 cells about it that holds more than k
/// points, itself included, with cells of 2, 4, 8 and 16 cm.
///
/// This stands for the k nearest neighbours where all that matters is over which points a region may spread: the block
/// grows as the cloud thins out, as their radius does, but its points follow each other in memory, all points of its
/// middle cell share it, and no tree has to be built and descended. Points that are too lonely for the largest block
/// get that block.
class NeighbourBlocks {
 public:
  /// @param points  any frame [m]; one that is not finite has no surroundings.
  /// @param count   k.
  /// Cost: O(N), a grouping by cells for each of the four sizes.
  NeighbourBlocks(std::span<const Eigen::Vector3f> points, std::size_t count);

  std::size_t size() const { return starts_.size() - 1; }
  std::uint32_t block_of(std::size_t point) const { return block_of_[point]; }

  /// Calls `visit(point)` for all points of a block.
  template <class Visit>
  void for_each_point(std::uint32_t block, Visit visit) const {
    for (std::uint32_t run = starts_[block]; run < starts_[block + 1]; ++run)
      for (std::uint32_t i = runs_[run].first; i < runs_[run].last; ++i) visit(order_[i]);
  }

 private:
  void add_level(std::span<const Eigen::Vector3f> points, double leaf_m, std::size_t wanted);

  struct Run {
    std::uint32_t first, last;  // in order_
  };
  std::vector<std::uint32_t> order_;  // points sorted into cells, one size of cells after the other
  std::vector<Run> runs_;
  std::vector<std::uint32_t> starts_;  // of each block, in runs_
  std::vector<std::uint32_t> block_of_;
};

}  // namespace stairway::detect
