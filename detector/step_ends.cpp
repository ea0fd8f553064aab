// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "detector/step_ends.hpp"

#include <algorithm>
#include <cmath>

namespace stairway::detect {
namespace {

constexpr double kEndFloor_m = 0.003;   // what one end may be off by for reasons its scatter does not show
constexpr double kCommonEnd_m = 0.002;  // what the ends of all steps may be off by alike
constexpr double kLonelyEnd_m = 0.02;   // an end that one step alone shows
constexpr double kAgreeingEnds = 2.5;   // sigmas

/// Ends of steps that agree.
struct EndCluster {
  double place = 0.0;
  double weight = 0.0;  ///< one over the variance of their mean [1/m^2]
};

EndCluster agreeing_ends(const std::vector<Estimate>& ends, double place) {
  constexpr int kRounds = 3;
  EndCluster cluster{.place = place};
  for (int round = 0; round < kRounds; ++round) {
    double weight = 0.0, sum = 0.0;
    for (const Estimate& end : ends) {
      const double sigma = std::hypot(end.sigma, kEndFloor_m);
      if (std::abs(end.value - cluster.place) > kAgreeingEnds * sigma) continue;
      weight += 1.0 / (sigma * sigma);
      sum += end.value / (sigma * sigma);
    }
    if (weight > 0.0) cluster = {sum / weight, weight};
  }
  return cluster;
}

}  // namespace

std::optional<Estimate> common_end(const std::vector<Estimate>& ends, double outward) {
  constexpr double kManyOfMost = 0.4;
  if (ends.empty()) return std::nullopt;
  if (ends.size() == 1) return Estimate{ends[0].value, std::hypot(ends[0].sigma, kLonelyEnd_m)};
  std::vector<EndCluster> clusters;
  double most = 0.0;
  for (const Estimate& end : ends) {
    clusters.push_back(agreeing_ends(ends, end.value));
    most = std::max(most, clusters.back().weight);
  }
  std::erase_if(clusters, [&](const EndCluster& cluster) { return cluster.weight < kManyOfMost * most; });
  const auto outermost =
      std::max_element(clusters.begin(), clusters.end(),
                       [&](const EndCluster& x, const EndCluster& y) { return outward * x.place < outward * y.place; });
  return Estimate{outermost->place, std::hypot(1.0 / std::sqrt(outermost->weight), kCommonEnd_m)};
}

}  // namespace stairway::detect
