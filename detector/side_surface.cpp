// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "detector/side_surface.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "detector/statistics.hpp"

namespace stairway::detect {
namespace {

constexpr double kFarthest_m = 0.1;
constexpr double kSurelyOff = 3.0;  // reaches from the face
constexpr double kThickness_m = 0.02;
constexpr std::size_t kFewest = 30;

enum class Side { Wall, Flank };

bool is_surely_off(const SideSight& sight, Side side, double reach_m) {
  return (side == Side::Flank ? sight.farther_m : -sight.farther_m) > kSurelyOff * reach_m;
}

// The middle of what lies closest together.
std::optional<double> densest_place(std::vector<double> places) {
  std::sort(places.begin(), places.end());
  std::size_t most = 0;
  double place = 0.0;
  for (std::size_t first = 0, end = 0; first < places.size(); ++first) {
    while (end < places.size() && places[end] < places[first] + kThickness_m) ++end;
    if (end - first <= most) continue;
    most = end - first;
    place = places[first + most / 2];
  }
  return most < kFewest ? std::nullopt : std::optional(place);
}

// What meets a face beyond a wall ends beyond the wall; a flank is seen for a step's depth only, from ahead a narrow
// strip. What stands before a surface does not matter.
bool stops_all(std::span<const SideSight> sights, Side side, double place_m) {
  constexpr double kFewestStopped = 15.0;
  constexpr double kMostPast = 0.1;
  const double nearest_m = side == Side::Wall ? 0.03 : 0.01;
  const double farthest_m = side == Side::Wall ? 0.10 : 0.05;
  double stopped = 0.0;
  double past = 0.0;
  for (const SideSight& sight : sights) {
    const double out_m = sight.crossing_m - place_m;
    if (out_m < nearest_m || out_m > farthest_m) continue;
    const double ended_m = sight.ended_m - place_m;
    past += ended_m > kThickness_m ? 1.0 : 0.0;
    stopped += std::abs(ended_m) < kThickness_m ? 1.0 : 0.0;
  }
  return stopped >= kFewestStopped && past < kMostPast * stopped;
}

std::optional<Estimate> find_surface(std::span<const SideSight> sights, Side side, double about_m, double reach_m) {
  std::vector<double> places;
  for (const SideSight& sight : sights)
    if (is_surely_off(sight, side, reach_m) && std::abs(sight.ended_m - about_m) < kFarthest_m)
      places.push_back(sight.ended_m);
  while (const std::optional<double> dense = densest_place(places)) {
    std::vector<double> close = places;
    std::erase_if(close, [&](double place) { return std::abs(place - *dense) > kThickness_m; });
    const double middle = median(close);
    if (stops_all(sights, side, middle))
      return Estimate{middle, robust_deviation(close, middle) / std::sqrt(static_cast<double>(close.size()))};
    // Balusters before a wall may stop more beams than it does.
    std::erase_if(places, [&](double place) { return place < *dense + kThickness_m; });
  }
  return std::nullopt;
}

}  // namespace

std::optional<Estimate> find_side_surface(std::span<const SideSight> sights, double about_m, double reach_m) {
  const std::optional<Estimate> wall = find_surface(sights, Side::Wall, about_m, reach_m);
  return wall ? wall : find_surface(sights, Side::Flank, about_m, reach_m);
}

}  // namespace stairway::detect
