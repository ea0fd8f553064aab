// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "tools/common/stairway_match.hpp"

#include <algorithm>
#include <limits>
#include <tuple>

namespace stairway::tools {
namespace {

constexpr double kSameStairway_m = 0.5;

double mean_distance(const detect::Stairway& found, const detect::Stairway& truth) {
  double sum = 0.0;
  for (const detect::Nosing& nosing : found.nosings) {
    double nearest = std::numeric_limits<double>::infinity();
    for (const detect::Nosing& other : truth.nosings)
      nearest = std::min(nearest, (nosing.middle() - other.middle()).norm());
    sum += nearest;
  }
  return sum / static_cast<double>(found.nosings.size());
}

}  // namespace

std::vector<std::pair<std::size_t, std::size_t>> match(const std::vector<detect::Stairway>& truth,
                                                       const std::vector<detect::Stairway>& found) {
  std::vector<std::tuple<double, std::size_t, std::size_t>> candidates;
  for (std::size_t t = 0; t < truth.size(); ++t) {
    for (std::size_t f = 0; f < found.size(); ++f) {
      const double distance = mean_distance(found[f], truth[t]);
      if (distance < kSameStairway_m) candidates.emplace_back(distance, t, f);
    }
  }
  std::sort(candidates.begin(), candidates.end());
  std::vector<std::pair<std::size_t, std::size_t>> pairs;
  for (const auto& [distance, t, f] : candidates) {
    const auto is_taken = [t = t, f = f](const auto& pair) { return pair.first == t || pair.second == f; };
    if (std::none_of(pairs.begin(), pairs.end(), is_taken)) pairs.emplace_back(t, f);
  }
  return pairs;
}

}  // namespace stairway::tools
