// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "tools/stairwayd/stairway_tracker.hpp"

#include <algorithm>
#include <cstddef>
#include <limits>

namespace stairway::daemon {
namespace {

using detect::Nosing;
using detect::Stairway;

constexpr double kSamePlace_m = 0.3;
constexpr int kMaxMissedPasses = 3;
constexpr double kFarAway_m = std::numeric_limits<double>::infinity();

// The anchor itself changes its side with the railings that are seen.
Nosing entry(const Stairway& stairway) {
  return stairway.nosings.empty() ? Nosing{stairway.anchor, stairway.anchor} : stairway.met_nosing();
}

double distance_m(const Eigen::Vector3d& point, const Nosing& edge) {
  const Eigen::Vector3d along = edge.right - edge.left;
  const double length2 = along.squaredNorm();
  const double share = length2 > 0.0 ? std::clamp((point - edge.left).dot(along) / length2, 0.0, 1.0) : 0.0;
  return (point - edge.left - share * along).norm();
}

bool is_same_sort(const Stairway& one, const Stairway& other) {
  return one.kind == other.kind && one.direction == other.direction;
}

/// Infinite when they cannot be the same.
double distance_m(const std::optional<Stairway>& before, const Stairway& now, bool may_be_parts) {
  if (!before || !is_same_sort(*before, now)) return kFarAway_m;
  const Nosing one = entry(*before), other = entry(now);
  const double middles_m = (one.middle() - other.middle()).norm();
  if (middles_m < kSamePlace_m) return middles_m;
  const double edges_m = std::min(distance_m(one.middle(), other), distance_m(other.middle(), one));
  if (may_be_parts && edges_m < kSamePlace_m) return middles_m;
  return kFarAway_m;
}

struct Pair {
  double distance_m;
  std::size_t track;
  std::size_t stairway;
};

}  // namespace

std::vector<std::int64_t> StairwayTracker::follow(std::span<const Stairway> stairways) {
  std::vector<std::int64_t> ids = number(stairways, false);
  for (Track& track : tracks_) track.missed_passes = track.is_seen ? 0 : track.missed_passes + 1;
  std::erase_if(tracks_, [](const Track& track) { return track.missed_passes > kMaxMissedPasses; });
  return ids;
}

std::vector<std::int64_t> StairwayTracker::follow_preview(std::span<const Stairway> stairways) {
  return number(stairways, true);
}

std::vector<std::int64_t> StairwayTracker::number(std::span<const Stairway> stairways, bool is_preview) {
  std::vector<Pair> pairs;
  for (std::size_t t = 0; t < tracks_.size(); ++t) {
    tracks_[t].is_seen = false;
    for (std::size_t s = 0; s < stairways.size(); ++s) {
      const double nearest_m = std::min(distance_m(tracks_[t].last, stairways[s], is_preview),
                                        distance_m(tracks_[t].preview, stairways[s], true));
      if (nearest_m < kFarAway_m) pairs.push_back({nearest_m, t, s});
    }
  }
  std::ranges::sort(pairs, {}, &Pair::distance_m);

  std::vector<std::int64_t> ids(stairways.size(), 0);
  const auto note = [&](Track& track, std::size_t stairway) {
    ids[stairway] = track.id;
    track.is_seen = true;
    (is_preview ? track.preview : track.last) = stairways[stairway];
    if (!is_preview) track.preview.reset();
  };
  for (const Pair& pair : pairs) {
    if (!tracks_[pair.track].is_seen && ids[pair.stairway] == 0) note(tracks_[pair.track], pair.stairway);
  }
  for (std::size_t s = 0; s < stairways.size(); ++s) {
    if (ids[s] == 0) note(tracks_.emplace_back(Track{next_id_++, {}, {}}), s);
  }
  return ids;
}

}  // namespace stairway::daemon
