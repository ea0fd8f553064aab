// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "detector/edge_strips.hpp"

namespace stairway::detect {

std::optional<Estimate> common_place(const std::vector<EdgePlace>& edges, double floor) {
  constexpr std::size_t kFewest = 3;
  if (edges.size() < kFewest) return std::nullopt;
  std::vector<double> places;
  for (const EdgePlace& edge : edges) places.push_back(edge.place);
  return robust_mean(places, floor);
}

}  // namespace stairway::detect
