// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "tools/stairwayd/stairway_tracker.hpp"

#include <algorithm>
#include <cstddef>

namespace stairway::daemon {
namespace {

constexpr double kSamePlace_m = 0.3;
constexpr int kMaxMissedPasses = 3;

// The middle of the nosing: the anchor itself changes its side with the railings that are seen.
Eigen::Vector3d entry(const detect::Stairway& stairway) {
  return stairway.nosings.empty() ? stairway.anchor : stairway.met_nosing().middle();
}

struct Pair {
  double distance_m;
  std::size_t track;
  std::size_t stairway;
};

}  // namespace

std::vector<std::int64_t> StairwayTracker::follow(std::span<const detect::Stairway> stairways) {
  std::vector<Pair> pairs;
  for (std::size_t t = 0; t < tracks_.size(); ++t) {
    for (std::size_t s = 0; s < stairways.size(); ++s) {
      const detect::Stairway &before = tracks_[t].last, &now = stairways[s];
      const double distance_m = (entry(before) - entry(now)).norm();
      if (before.kind == now.kind && before.direction == now.direction && distance_m < kSamePlace_m)
        pairs.push_back({distance_m, t, s});
    }
  }
  std::ranges::sort(pairs, {}, &Pair::distance_m);

  for (Track& track : tracks_) ++track.missed_passes;
  std::vector<std::int64_t> ids(stairways.size(), 0);
  for (const Pair& pair : pairs) {
    Track& track = tracks_[pair.track];
    if (track.missed_passes == 0 || ids[pair.stairway] != 0) continue;
    track.missed_passes = 0;
    track.last = stairways[pair.stairway];
    ids[pair.stairway] = track.id;
  }
  std::erase_if(tracks_, [](const Track& track) { return track.missed_passes > kMaxMissedPasses; });
  for (std::size_t s = 0; s < stairways.size(); ++s) {
    if (ids[s] != 0) continue;
    ids[s] = next_id_++;
    tracks_.push_back({ids[s], stairways[s]});
  }
  return ids;
}

}  // namespace stairway::daemon
