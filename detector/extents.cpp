// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "detector/extents.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "detector/statistics.hpp"

namespace stairway::detect {
namespace {

constexpr std::size_t kMinPointsPerStrip = 3;

}  // namespace

double overlap(const Interval& a, const Interval& b) { return std::min(a.high, b.high) - std::max(a.low, b.low); }

Interval full_extent(std::span<const Eigen::Vector3f> points, std::span<const std::uint32_t> chosen,
                     const Eigen::Vector3d& axis) {
  Interval extent{std::numeric_limits<double>::max(), std::numeric_limits<double>::lowest()};
  for (const std::uint32_t i : chosen) {
    const double value = points[i].cast<double>().dot(axis);
    extent.low = std::min(extent.low, value);
    extent.high = std::max(extent.high, value);
  }
  return extent;
}

Interval robust_extent(std::span<const Eigen::Vector3f> points, std::span<const std::uint32_t> chosen,
                       const Eigen::Vector3d& axis, const Eigen::Vector3d& across, double strip_m) {
  const Interval side = full_extent(points, chosen, across);
  const auto strips = static_cast<std::size_t>(side.length() / strip_m) + 1;
  struct Strip {
    std::size_t count = 0;
    Interval extent{std::numeric_limits<double>::max(), std::numeric_limits<double>::lowest()};
  };
  std::vector<Strip> profile(strips);
  for (const std::uint32_t i : chosen) {
    const Eigen::Vector3d p = points[i].cast<double>();
    const auto place = static_cast<std::size_t>((p.dot(across) - side.low) / strip_m);
    Strip& strip = profile[std::min(place, strips - 1)];
    const double value = p.dot(axis);
    strip.extent.low = std::min(strip.extent.low, value);
    strip.extent.high = std::max(strip.extent.high, value);
    ++strip.count;
  }
  std::vector<double> lows;
  std::vector<double> highs;
  for (const Strip& strip : profile) {
    if (strip.count < kMinPointsPerStrip) continue;
    lows.push_back(strip.extent.low);
    highs.push_back(strip.extent.high);
  }
  if (lows.empty()) return full_extent(points, chosen, axis);
  return {median(std::move(lows)), median(std::move(highs))};
}

}  // namespace stairway::detect
