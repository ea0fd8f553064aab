// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "detector/step_front.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "detector/step_line.hpp"

namespace stairway::detect {
namespace {

constexpr double kBarHeight_m = 0.05;  // the front of an open tread lies within this below its nosing
constexpr double kMixedShare = 0.25;   // of the spot's radius, what mixed pixels may shift such a front by

/// Points of a front and the straight line through them; v from the middle of the sides.
struct Front : StepLine {
  std::vector<double> places;
  std::vector<double> heights;
  double count() const { return static_cast<double>(heights.size()); }
};

bool fills(const std::vector<double>& heights, const Interval& zone) {
  constexpr std::size_t kRows = 4;
  constexpr double kFairShare = 0.3;
  std::array<std::size_t, kRows> rows{};
  for (const double z : heights)
    ++rows[std::min(kRows - 1, static_cast<std::size_t>((z - zone.low) / zone.length() * static_cast<double>(kRows)))];
  const double fair = kFairShare * static_cast<double>(heights.size()) / static_cast<double>(kRows);
  return std::all_of(rows.begin(), rows.end(), [&](std::size_t n) { return static_cast<double>(n) >= fair; });
}

void follow(const StepView& view, const std::vector<StepPoint>& points, Front& front) {
  std::vector<PlacePoint> line;
  front.places.clear();
  front.heights.clear();
  for (const StepPoint& p : points) {
    const double v = p.v - view.sides().middle();
    if (std::abs(p.u - front.value - front.turn * v) > view.reach_m()) continue;
    line.push_back({p.u, v});
    front.places.push_back(p.v);
    front.heights.push_back(p.z);
  }
  fit_line(line, front);
}

std::optional<Front> front_within(const StepView& view, const Interval& zone) {
  std::vector<StepPoint> near;
  std::size_t behind = 0;
  for (const StepPoint& p : view.points()) {
    const double depth = p.u - view.front_u();
    const double next = view.depth_at(p.v);
    if (depth < -2.0 * view.options().search_m || depth > next || !view.lies_between_sides(p)) continue;
    const double z = view.at_front(p).z;
    if (z < zone.low || z > zone.high) continue;
    if (std::abs(depth) < 2.0 * view.options().search_m) near.push_back({p.u, p.v, z});
    if (depth > view.options().search_m && depth < next - view.options().search_m) ++behind;
  }
  std::vector<double> places;
  for (const StepPoint& p : near)
    if (std::abs(p.u - view.front_u()) < view.options().search_m) places.push_back(p.u);
  if (places.size() < static_cast<std::size_t>(view.options().min_points)) return std::nullopt;
  std::sort(places.begin(), places.end());

  Front front;
  front.value = densest_place(places, view.reach_m());
  constexpr int kPasses = 2;  // the second follows the slope that the first has found
  for (int pass = 0; pass < kPasses; ++pass) follow(view, near, front);
  if (front.heights.size() < static_cast<std::size_t>(view.options().min_points)) return std::nullopt;
  const double free_depth = std::max(view.model().depth_m - 2.0 * view.options().search_m, 0.01);
  const double contrast =
      front.count() / (2.0 * view.reach_m()) / std::max(static_cast<double>(behind) / free_depth, 1e-9);
  if (contrast < view.options().min_contrast || !view.covers_sides(front.places)) return std::nullopt;
  return front;
}

}  // namespace

// A riser is seen clean where the whole spot lies on it. Where none is filled with points, the front of an open tread
// may be: a bar in which the spot hardly finds a clean place.
std::optional<FrontMeasurement> measure_front(const StepView& view) {
  const double bottom = view.visible_bottom_m();
  const double margin = std::min(view.spot_radius_m(), -0.25 * bottom);
  const Interval riser{bottom + margin, -margin};
  std::optional<Front> front = riser.length() > 0.0 ? front_within(view, riser) : std::nullopt;
  double systematic = 0.0;
  if (!front || !fills(front->heights, riser)) {
    const std::optional<Front> bar = front_within(view, {-kBarHeight_m, 0.5 * view.spot_radius_m()});
    if (bar) {
      front = bar;
      systematic = kMixedShare * view.spot_radius_m();
    }
  }
  if (!front) return std::nullopt;
  const double sigma = std::hypot(view.options().range_sigma_m / std::sqrt(front->count()), systematic);
  FrontMeasurement measurement{.place = {front->value, sigma}, .turn = {}};
  if (front->variance_v > 0.0) measurement.turn = Estimate{front->turn, sigma / std::sqrt(front->variance_v)};
  return measurement;
}

}  // namespace stairway::detect
