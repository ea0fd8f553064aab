// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "detector/sight_fan.hpp"

#include <algorithm>
#include <cmath>

namespace stairway::detect {
namespace {

constexpr double kQuarterTurns = 4.0;
constexpr std::size_t kBuckets = 4096;

// Rises from 0 at the start, over 1 ahead, to 4 at the start again: as an angle does, but not evenly.
double turned_by(const Eigen::Vector2d& sight) {
  const double length = std::abs(sight.x()) + std::abs(sight.y());
  if (!(length > 0.0)) return 0.0;
  const double from_start = 1.0 - sight.y() / length;
  return sight.x() >= 0.0 ? from_start : kQuarterTurns - from_start;
}

std::size_t bucket_of(double turned) {
  return std::min(static_cast<std::size_t>(turned * (kBuckets / kQuarterTurns)), kBuckets - 1);
}

}  // namespace

SightFan::SightFan(std::vector<Eigen::Vector3d>& points, const Eigen::Vector3d& sensor, const Eigen::Vector3d& start,
                   const Eigen::Vector3d& ahead)
    : sensor_(sensor), start_(start), ahead_(ahead), starts_(kBuckets + 1, 0) {
  std::vector<std::uint16_t> buckets(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    buckets[i] = static_cast<std::uint16_t>(bucket_of(turned_by(in_plane(points[i]))));
    ++starts_[buckets[i] + std::size_t{1}];
  }
  for (std::size_t i = 1; i < starts_.size(); ++i) starts_[i] += starts_[i - 1];
  std::vector<std::uint32_t> next = starts_;
  std::vector<Eigen::Vector3d> sorted(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) sorted[next[buckets[i]]++] = points[i];
  points = std::move(sorted);
}

std::pair<std::size_t, std::size_t> SightFan::within_or_behind(std::span<const Eigen::Vector3d> corners) const {
  double first = kQuarterTurns;
  double last = 0.0;
  for (const Eigen::Vector3d& corner : corners) {
    const double turned = turned_by(in_plane(corner));
    first = std::min(first, turned);
    last = std::max(last, turned);
  }
  // What spans half a turn is around the sensor or at the start.
  if (last - first >= 0.5 * kQuarterTurns) return {0, starts_.back()};
  return {starts_[bucket_of(first)], starts_[bucket_of(last) + 1]};
}

}  // namespace stairway::detect
