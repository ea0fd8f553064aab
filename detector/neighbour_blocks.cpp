// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "detector/neighbour_blocks.hpp"

#include <array>

#include "detector/cell_groups.hpp"

namespace stairway::detect {
namespace {

constexpr std::array kLeaves_m{0.02, 0.04, 0.08, 0.16};
constexpr std::uint32_t kNobody = 0;  // the block without points

}  // namespace

NeighbourBlocks::NeighbourBlocks(std::span<const Eigen::Vector3f> points, std::size_t count)
    : starts_{0, 0}, block_of_(points.size(), kNobody) {
  for (const double leaf_m : kLeaves_m) add_level(points, leaf_m, leaf_m < kLeaves_m.back() ? count + 1 : 0);
}

void NeighbourBlocks::add_level(std::span<const Eigen::Vector3f> points, double leaf_m, std::size_t wanted) {
  const CellGroups cells = group_by_cell(points, leaf_m);
  const auto offset = static_cast<std::uint32_t>(order_.size());
  order_.insert(order_.end(), cells.order.begin(), cells.order.end());
  CellRows rows(cells, 1);
  for (std::size_t cell = 0; cell < cells.size(); ++cell) {
    const auto block = static_cast<std::uint32_t>(size());
    bool is_wanted = false;
    for (const std::uint32_t point : cells[cell]) is_wanted = is_wanted || block_of_[point] == kNobody;
    if (!is_wanted) continue;
    std::size_t held = 0;
    const std::size_t before = runs_.size();
    rows.around(cell, [&](std::size_t first, std::size_t last) {
      runs_.push_back({offset + cells.starts[first], offset + cells.starts[last]});
      held += cells.starts[last] - cells.starts[first];
    });
    if (held < wanted) {
      runs_.resize(before);
      continue;
    }
    starts_.push_back(static_cast<std::uint32_t>(runs_.size()));
    for (const std::uint32_t point : cells[cell])
      if (block_of_[point] == kNobody) block_of_[point] = block;
  }
}

}  // namespace stairway::detect
