// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "detector/sight_edge.hpp"

#include <algorithm>
#include <cmath>

namespace stairway::detect {

std::optional<SightEdge> edge_between(std::vector<Crossing>& crossings) {
  constexpr std::size_t kFewest = 4;
  if (crossings.size() < kFewest) return std::nullopt;
  std::sort(crossings.begin(), crossings.end(), [](const Crossing& a, const Crossing& b) { return a.place < b.place; });
  const auto ons = std::count_if(crossings.begin(), crossings.end(), [](const Crossing& c) { return c.on; });
  if (ons == 0 || ons == static_cast<std::ptrdiff_t>(crossings.size())) return std::nullopt;

  // Wrong are those beyond the edge that end on the surface and those before it that do not; at first all lie before.
  auto wrong = static_cast<std::ptrdiff_t>(crossings.size()) - ons;
  auto fewest_wrong = wrong;
  std::size_t last = crossings.size();  // of the best splits
  std::size_t first = last;
  for (std::size_t split = crossings.size(); split-- > 0;) {
    wrong += crossings[split].on ? 1 : -1;
    if (wrong < fewest_wrong) last = split;
    if (wrong <= fewest_wrong) first = split;
    fewest_wrong = std::min(fewest_wrong, wrong);
  }
  if (first == 0 || last == crossings.size() || 4 * fewest_wrong > static_cast<std::ptrdiff_t>(crossings.size()))
    return std::nullopt;
  const double low = crossings[first - 1].place;
  const double high = crossings[last].place;
  const double spacing = (crossings.back().place - crossings.front().place) / static_cast<double>(crossings.size());
  return SightEdge{0.5 * (low + high), std::hypot((high - low) / std::sqrt(12.0),
                                                  spacing * std::sqrt(0.5 * static_cast<double>(fewest_wrong)))};
}

}  // namespace stairway::detect
