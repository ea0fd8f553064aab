// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "detector/sight_edge.hpp"

#include <algorithm>

namespace stairway::detect {

std::optional<double> edge_between(std::vector<Crossing>& crossings) {
  constexpr std::size_t kFewest = 4;
  if (crossings.size() < kFewest) return std::nullopt;
  std::sort(crossings.begin(), crossings.end(), [](const Crossing& a, const Crossing& b) { return a.place < b.place; });
  const auto ons = std::count_if(crossings.begin(), crossings.end(), [](const Crossing& c) { return c.on; });
  if (ons == 0 || ons == static_cast<std::ptrdiff_t>(crossings.size())) return std::nullopt;

  // Wrong are those beyond the edge that end on the surface and those before it that do not; at first all lie before.
  auto wrong = static_cast<std::ptrdiff_t>(crossings.size()) - ons;
  auto fewest_wrong = wrong;
  std::size_t best = crossings.size();
  for (std::size_t split = crossings.size(); split-- > 0;) {
    wrong += crossings[split].on ? 1 : -1;
    if (wrong < fewest_wrong) {
      fewest_wrong = wrong;
      best = split;
    }
  }
  if (best == 0 || best == crossings.size() || 4 * fewest_wrong > static_cast<std::ptrdiff_t>(crossings.size()))
    return std::nullopt;
  return 0.5 * (crossings[best - 1].place + crossings[best].place);
}

}  // namespace stairway::detect
