// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "detector/spot.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace stairway::detect {
namespace {

struct Part {
  double range_m = 0.0;
  double share = 0.0;
};

/// Parts that answer in one echo.
struct Group {
  double share = 0.0;
  double sum_m = 0.0;
  double nearest_m = 0.0;
  double farthest_m = 0.0;
  double range_m() const { return sum_m / share; }
};

constexpr std::size_t kMostParts = 8;

struct Parts {
  std::array<Part, kMostParts> list;
  std::size_t count = 0;
};

struct Groups {
  std::array<Group, 2> list;
  std::size_t count = 0;
  bool is_certain = true;
};

// Nobody knows exactly how near two surfaces must be to answer together.
Groups group(Parts& parts, double separation_m) {
  constexpr double kSurelyOne = 0.75;
  constexpr double kSurelyTwo = 1.4;
  std::sort(parts.list.begin(), parts.list.begin() + static_cast<std::ptrdiff_t>(parts.count),
            [](const Part& a, const Part& b) { return a.range_m < b.range_m; });
  Groups groups;
  for (std::size_t i = 0; i < parts.count; ++i) {
    const Part& part = parts.list[i];
    const double gap = i == 0 ? 0.0 : part.range_m - parts.list[i - 1].range_m;
    if (gap > kSurelyOne * separation_m && gap < kSurelyTwo * separation_m) groups.is_certain = false;
    if (i == 0 || gap >= separation_m) {
      if (groups.count == groups.list.size()) return {.count = 0, .is_certain = false};
      groups.list[groups.count++] = {.nearest_m = part.range_m};
    }
    Group& last = groups.list[groups.count - 1];
    last.share += part.share;
    last.sum_m += part.share * part.range_m;
    last.farthest_m = part.range_m;
  }
  return groups;
}

SpotEcho echo_of_groups(const Groups& groups) {
  SpotEcho echo{.is_known = groups.count > 0 && groups.is_certain, .is_mixed = true};
  if (!echo.is_known) return echo;
  const Group& near = groups.list[0];
  if (groups.count == 1) {
    echo.range_m = near.range_m();
    echo.spread_m = near.farthest_m - near.nearest_m;
    return echo;
  }
  const Group& far = groups.list[1];
  const Group& larger = near.share >= far.share ? near : far;
  echo.is_split = true;
  echo.near_share = near.share / (near.share + far.share);
  echo.near_m = near.range_m();
  echo.far_m = far.range_m();
  echo.range_m = larger.range_m();
  echo.spread_m = larger.farthest_m - larger.nearest_m;
  return echo;
}

}  // namespace

double share_below_chord(double x) {
  if (x <= -1.0) return 0.0;
  if (x >= 1.0) return 1.0;
  return 0.5 + (x * std::sqrt(1.0 - x * x) + std::asin(x)) / std::numbers::pi;
}

SpotEcho echo_of(std::span<const VisibleFace> faces, const Elevation& at, double spread_rad, const Backdrop& backdrop,
                 double pulse_separation_m) {
  constexpr double kLeastShare = 0.002;
  const double low = at.rad - spread_rad;
  const double high = at.rad + spread_rad;
  auto face = std::lower_bound(faces.begin(), faces.end(), low,
                               [](const VisibleFace& f, double below) { return f.end_rad < below; });
  const auto range_on = [&](const VisibleFace& f, const Elevation& sight) {
    return f.kind == VisibleFace::Kind::Beyond ? backdrop.range_m(sight.rad) : f.distance_m(sight);
  };
  if (face == faces.end() || face->kind == VisibleFace::Kind::Unknown) return {};
  if (face->end_rad >= high) {
    const double range = range_on(*face, at);
    return {.is_known = std::isfinite(range), .is_past = face->kind == VisibleFace::Kind::Beyond, .range_m = range};
  }
  Parts parts;
  bool misses = true;
  double before = 0.0;
  for (; face != faces.end() && face->begin_rad < high; ++face) {
    const double end = std::min(face->end_rad, high);
    const double below = spread_rad > 0.0 ? share_below_chord((end - at.rad) / spread_rad) : 1.0;
    const double share = below - before;
    before = below;
    if (share < kLeastShare) continue;
    const double range = range_on(*face, at.near_by(0.5 * (std::max(face->begin_rad, low) + end)));
    const bool is_known = face->kind != VisibleFace::Kind::Unknown && range > 0.0 && std::isfinite(range);
    if (!is_known || parts.count == kMostParts) return {};
    parts.list[parts.count++] = {range, share};
    misses = misses && face->kind == VisibleFace::Kind::Beyond;
  }
  if (misses && parts.count > 0) return {.is_known = true, .is_past = true, .range_m = parts.list[0].range_m};
  return parts.count == 0 ? SpotEcho{} : echo_of_groups(group(parts, pulse_separation_m));
}

}  // namespace stairway::detect
