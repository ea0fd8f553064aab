// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "detector/part_grid.hpp"

#include <algorithm>
#include <cmath>

namespace stairway::detect {
namespace {

std::vector<Eigen::Vector2d> centroids(const std::vector<StairPart>& parts) {
  std::vector<Eigen::Vector2d> places;
  places.reserve(parts.size());
  for (const StairPart& part : parts) places.emplace_back(part.centroid.head<2>());
  return places;
}

}  // namespace

PartGrid::PartGrid(const std::vector<Eigen::Vector2d>& places, double cell_m) : cell_m_(cell_m) {
  entries_.reserve(places.size());
  for (std::size_t i = 0; i < places.size(); ++i) entries_.emplace_back(cell_of(places[i]), i);
  std::sort(entries_.begin(), entries_.end());
}

PartGrid::PartGrid(const std::vector<StairPart>& parts, double cell_m) : PartGrid(centroids(parts), cell_m) {}

PartGrid::Cell PartGrid::cell_of(const Eigen::Vector2d& place) const {
  return {static_cast<std::int64_t>(std::floor(place.x() / cell_m_)),
          static_cast<std::int64_t>(std::floor(place.y() / cell_m_))};
}

void PartGrid::around(const Eigen::Vector2d& place, double radius_m, std::vector<std::size_t>& found) const {
  found.clear();
  const Cell low = cell_of(place - Eigen::Vector2d::Constant(radius_m));
  const Cell high = cell_of(place + Eigen::Vector2d::Constant(radius_m));
  const auto before = [](const auto& entry, const Cell& cell) { return entry.first < cell; };
  auto entry = std::lower_bound(entries_.begin(), entries_.end(), low, before);
  while (entry != entries_.end() && entry->first.first <= high.first) {
    const auto [x, y] = entry->first;
    if (y < low.second) {
      entry = std::lower_bound(entry, entries_.end(), Cell{x, low.second}, before);
    } else if (y > high.second) {
      entry = std::lower_bound(entry, entries_.end(), Cell{x + 1, low.second}, before);
    } else {
      found.push_back(entry->second);
      ++entry;
    }
  }
  std::sort(found.begin(), found.end());
}

}  // namespace stairway::detect
