// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "detector/handrail_search.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "detector/extents.hpp"
#include "detector/plane.hpp"
#include "detector/statistics.hpp"

namespace stairway::detect {
namespace {

constexpr double kGrid_m = 0.02;       // between the places where a bar is looked for
constexpr double kHalfWidth_m = 0.04;  // of the bar as it is looked for: a wall 5 cm behind it stays out
constexpr double kHalfHeight_m = 0.05;
constexpr double kPiece_m = 0.07;  // the bar is made of pieces of this length,
constexpr long kMaxGap = 3;        // of which two in a row may be missing
constexpr double kMinPieceShare = 0.6;
constexpr double kMaxShareAround = 0.25;  // of the points of the bar, in as large a space above it and inside of it
constexpr double kMaxShareBelow = 0.5;    // where there are balusters

struct Section {
  Interval beyond;
  Interval above;
  bool holds(const Eigen::Vector3d& p) const {
    return p.y() >= beyond.low && p.y() <= beyond.high && p.z() >= above.low && p.z() <= above.high;
  }
};

Interval about(double center, double half) { return {center - half, center + half}; }

std::vector<double> places(const Interval& range) {
  std::vector<double> result;
  for (double place = range.low; place <= range.high; place += kGrid_m) result.push_back(place);
  return result;
}

// The longest stretch without a large gap, if it has few small ones.
Interval longest_run(const std::vector<Eigen::Vector3d>& bar) {
  std::vector<long> pieces;
  for (const Eigen::Vector3d& p : bar) pieces.push_back(std::lround(p.x() / kPiece_m));
  std::sort(pieces.begin(), pieces.end());
  pieces.erase(std::unique(pieces.begin(), pieces.end()), pieces.end());
  Interval longest;
  for (std::size_t begin = 0, end = 0; begin < pieces.size(); begin = end) {
    for (end = begin + 1; end < pieces.size() && pieces[end] - pieces[end - 1] <= kMaxGap; ++end) {
    }
    const auto length = static_cast<double>(pieces[end - 1] - pieces[begin] + 1);
    if (static_cast<double>(end - begin) < kMinPieceShare * length || length * kPiece_m <= longest.length()) continue;
    longest = {(static_cast<double>(pieces[begin]) - 0.5) * kPiece_m,
               (static_cast<double>(pieces[end - 1]) + 0.5) * kPiece_m};
  }
  return longest;
}

struct Bar {
  double beyond = 0.0;  // its middle across the flight
  std::size_t points = 0;
};

class BarTest {
 public:
  BarTest(std::span<const Eigen::Vector3d> points, const RailingOptions& options)
      : points_(points), options_(options) {}

  std::optional<Bar> bar_at(double beyond, double above) const {
    const Section section{about(beyond, kHalfWidth_m), about(above, kHalfHeight_m)};
    std::vector<Eigen::Vector3d> bar;
    for (const Eigen::Vector3d& p : points_)
      if (section.holds(p)) bar.push_back(p);
    const Interval run = longest_run(bar);
    if (run.length() < options_.min_handrail_length_m) return std::nullopt;
    if (!stands_alone(section, run) || !runs_along(bar, run)) return std::nullopt;
    std::vector<double> across;
    for (const Eigen::Vector3d& p : bar) across.push_back(p.y());
    return Bar{median(std::move(across)), bar.size()};
  }

 private:
  double count(const Section& section, const Interval& run) const {
    return static_cast<double>(std::count_if(points_.begin(), points_.end(), [&](const Eigen::Vector3d& p) {
      return section.holds(p) && p.x() >= run.low && p.x() <= run.high;
    }));
  }

  // A wall goes on above, an edge inside, a parapet below.
  bool stands_alone(const Section& section, const Interval& run) const {
    const double off = 0.5 * options_.max_thickness_m + kHalfHeight_m;
    const double n = count(section, run);
    const double above_n = count({section.beyond, about(section.above.middle() + off, kHalfHeight_m)}, run);
    const double below_n = count({section.beyond, about(section.above.middle() - off, kHalfHeight_m)}, run);
    const double inside_n = count({about(section.beyond.middle() - off, kHalfWidth_m), section.above}, run);
    return above_n <= kMaxShareAround * n && inside_n <= kMaxShareAround * n && below_n <= kMaxShareBelow * n;
  }

  bool runs_along(const std::vector<Eigen::Vector3d>& bar, const Interval& run) const {
    PointMoments moments(bar.front());
    for (const Eigen::Vector3d& p : bar)
      if (p.x() >= run.low && p.x() <= run.high) moments.add(p.cast<float>());
    return std::abs(principal_axes(moments).axes(0, 0)) >= std::cos(options_.max_handrail_angle_rad);
  }

  std::span<const Eigen::Vector3d> points_;
  const RailingOptions& options_;
};

}  // namespace

std::optional<double> find_handrail(std::span<const Eigen::Vector3d> points, const RailingOptions& options) {
  const BarTest test(points, options);
  const double side = options.max_side_distance_m;
  Bar best;
  for (const double beyond : places({-side, side}))
    for (const double above : places({options.min_handrail_height_m, options.max_handrail_height_m}))
      if (const std::optional<Bar> bar = test.bar_at(beyond, above); bar && bar->points > best.points) best = *bar;
  return best.points > 0 ? std::optional(best.beyond) : std::nullopt;
}

}  // namespace stairway::detect
