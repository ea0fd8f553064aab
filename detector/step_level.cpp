// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "detector/step_level.hpp"

#include <algorithm>
#include <cmath>

#include "detector/statistics.hpp"
#include "detector/step_reaches.hpp"

namespace stairway::detect {
namespace {

constexpr double kGrazing = 0.03;     // of what the spot is too wide by, how far it may shift a tread
constexpr double kTreadMargin = 0.2;  // share of a tread at its front and back that is not measured

// Clear of the edges. From below one looks past the front, whose edge mixes with what lies beyond. From behind one
// looks over the next nosing, whose edge mixes with what lies below it.
bool lies_on_tread(const StepView& view, const StepPoint& p) {
  const double depth = view.depth_at(p.v);
  const double margin = kTreadMargin * depth;
  if (!view.stands_behind_tread()) {
    const bool is_clear = p.u > view.front_u() + margin && p.u < view.front_u() + depth - margin;
    const bool looks_from_below = view.sensor() && view.sensor()->z < 0.0;
    return is_clear && (!looks_from_below || view.at_front(p).z < -view.spot_radius_m());
  }
  const double slope = (view.sensor()->z - p.z) / (view.sensor()->u - p.u);
  const double over_next = p.z + (depth - p.u) * slope - view.model().height_m;
  const double over_nosing = p.z - p.u * slope;
  const double spot = view.spot_radius_m() * std::hypot(1.0, slope);
  return p.u < depth && over_next > spot && over_nosing < -spot;
}

// By how much the spot is wider than a tread looks that is seen at a grazing angle: then no point on it is clean.
double wider_than_tread_m(const StepView& view, double level_m) {
  if (!view.sensor()) return 0.0;
  const double slope = (view.sensor()->z - level_m) / std::hypot(view.sensor()->u, view.sensor()->v);
  return std::max(0.0, 2.0 * view.spot_radius_m() - view.model().depth_m * std::abs(slope));
}

}  // namespace

std::optional<Estimate> measure_level(const StepView& view, const Interval& range) {
  std::vector<double> heights;
  std::vector<double> places;
  for (const StepPoint& p : view.points()) {
    if (p.z < range.low || p.z > range.high || !view.lies_between_sides(p) || !lies_on_tread(view, p)) continue;
    heights.push_back(p.z);
    places.push_back(p.v);
  }
  if (heights.size() < static_cast<std::size_t>(view.options().min_points) || !view.covers_sides(places))
    return std::nullopt;
  std::vector<double> sorted = heights;
  std::sort(sorted.begin(), sorted.end());
  const double center = densest_place(sorted, view.reach_m());
  std::vector<double> near;
  for (const double height : heights)
    if (std::abs(height - center) <= view.reach_m()) near.push_back(height);
  const double off = static_cast<double>(heights.size() - near.size());
  const double fair = off * 2.0 * view.reach_m() / std::max(range.length() - 2.0 * view.reach_m(), 0.01);
  if (static_cast<double>(near.size()) < view.options().min_contrast * fair ||
      near.size() < static_cast<std::size_t>(view.options().min_points))
    return std::nullopt;
  constexpr double kFloor_m = 1e-4;
  Estimate level = robust_mean(near, kFloor_m);
  level.sigma = std::hypot(level.sigma, kGrazing * wider_than_tread_m(view, level.value));
  return level;
}

bool goes_on_before(const StepView& view, double level_m) {
  const double near = -kLandingNear * view.model().depth_m;
  const double far = -kLandingFar * view.model().depth_m;
  std::vector<double> places;
  for (const StepPoint& p : view.points())
    if (p.u > far && p.u < near && view.lies_between_sides(p) && std::abs(p.z - level_m) < view.reach_m())
      places.push_back(p.v);
  return places.size() >= static_cast<std::size_t>(view.options().min_points) && view.covers_sides(places);
}

std::optional<Estimate> inner_end(const StepView& view, double level_m) {
  constexpr double kBin_m = 0.02;
  constexpr double kThin = 0.5;
  constexpr double kBeside = 3.0;  // reaches above and below the level
  constexpr double kClear = 0.15;  // share of the depth next to the risers
  constexpr double kSigma_m = 0.01;
  const double sign = view.model().turn_rad > 0.0 ? 1.0 : -1.0;
  const double middle = view.sides().middle();
  const double to_axis = std::abs(view.model().radius_m()) - sign * middle;
  std::vector<double> densities(static_cast<std::size_t>(std::max(2.0, to_axis / kBin_m)), 0.0);
  for (const StepPoint& p : view.points()) {
    const double out = sign * (p.v - middle);
    const double depth = view.depth_at(p.v);
    const double off = std::abs(p.z - level_m);
    if (out < 0.0 || depth < kBin_m || off > kBeside * view.reach_m() || p.u < kClear * depth ||
        p.u > (1.0 - kClear) * depth)
      continue;
    const auto bin = static_cast<std::size_t>(out / kBin_m);
    // What goes on above and below is no tread but a column that stands close to its end.
    const double share = off <= view.reach_m() ? 1.0 : -1.0 / (kBeside - 1.0);
    if (bin < densities.size()) densities[bin] += share / depth;
  }
  const auto half_way = densities.begin() + static_cast<std::ptrdiff_t>((densities.size() + 1) / 2);
  const double thin = kThin * median({densities.begin(), half_way});
  for (std::size_t bin = 1; bin + 1 < densities.size(); ++bin) {
    if (densities[bin] >= thin || densities[bin + 1] >= thin) continue;
    const double share = (densities[bin - 1] - thin) / (densities[bin - 1] - densities[bin]);
    return Estimate{middle + sign * (static_cast<double>(bin) - 0.5 + std::clamp(share, 0.0, 1.0)) * kBin_m, kSigma_m};
  }
  return std::nullopt;
}

}  // namespace stairway::detect
