// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "detector/stair_part.hpp"

namespace stairway::detect {

/// Finds the parts near a place, so that the cost of a building grows with its size and not with the square of it.
class PartGrid {
 public:
  /// @param places  seen from above [m], finite.
  /// @param cell_m  edge of a cell [m], > 0; about the radius that will be asked for. Cost: O(P log P).
  PartGrid(const std::vector<Eigen::Vector2d>& places, double cell_m);
  /// By the centroids of parts.
  PartGrid(const std::vector<StairPart>& parts, double cell_m);

  /// Fills `found` with the indices, rising, of all parts within `radius_m` of `place`, and of some that are farther.
  void around(const Eigen::Vector2d& place, double radius_m, std::vector<std::size_t>& found) const;

  /// Parts for which `is_gone(index)` holds are not found any more. Cost: O(P).
  template <class Predicate>
  void remove_if(Predicate is_gone) {
    std::erase_if(entries_, [&](const auto& entry) { return is_gone(entry.second); });
  }

 private:
  using Cell = std::pair<std::int64_t, std::int64_t>;
  Cell cell_of(const Eigen::Vector2d& place) const;

  double cell_m_;
  std::vector<std::pair<Cell, std::size_t>> entries_;  // by cell
};

}  // namespace stairway::detect
