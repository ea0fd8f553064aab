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
constexpr double kMixedShare = 0.1;    // of the spot's radius, what mixed pixels shift one such front by unlike others

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

namespace {

constexpr double kLipHeight_m = 0.065;  // no lip is higher
constexpr double kLipMiddle_m = 0.018;  // below a nosing the lip, if there is one, is always found
constexpr double kLipReach_m = 0.006;
constexpr double kLowestLip_m = 0.030;
constexpr double kLeastZone_m = 0.03;
constexpr double kUnclearLip = 0.15;  // of the overhang, what the riser behind may shift a lip by

// Where the front shows its lip and nothing else; far away the spot reaches beyond it wherever it falls.
std::optional<Interval> lip_zone(const StepView& view) {
  const double middle = -std::max(kLipMiddle_m, view.spot_radius_m());
  if (middle < -kLowestLip_m) return std::nullopt;
  return Interval{middle - kLipReach_m, middle + kLipReach_m};
}

struct FrontZone {
  Interval z;
  bool is_lip = false;
};

// Where the front is clear of mixed pixels, and of the lip if it has one or may have one that cannot be told. Of the
// risers of high steps one sees hardly more than their lips.
FrontZone front_zone(const StepView& view) {
  const double bottom = view.visible_bottom_m();
  const double margin = std::min(view.spot_radius_m(), -0.25 * bottom);
  const Interval whole{bottom + margin, -margin};
  const Interval below_lip{whole.low, -kLipHeight_m - margin};
  const Interval lip{std::max(whole.low, -kLowestLip_m - margin), whole.high};
  if (!view.sensor() || !(view.has_lip() || !lip_zone(view))) return {whole};
  if (below_lip.length() > kLeastZone_m) return {below_lip};
  if (view.has_lip()) return {lip, true};
  return {whole};
}

}  // namespace

std::optional<Estimate> measure_lip(const StepView& view) {
  constexpr double kMixedLip = 0.1;  // of the spot's radius
  const std::optional<Interval> zone = lip_zone(view);
  if (!zone || !view.sensor()) return std::nullopt;
  const std::optional<Front> front = front_within(view, *zone);
  if (!front) return std::nullopt;
  return Estimate{front->value, std::hypot(view.options().range_sigma_m / std::sqrt(front->count()),
                                           kMixedLip * view.spot_radius_m())};
}

// A riser is seen clean where the whole spot lies on it. Where none is filled with points, the front of an open tread
// may be: a bar in which the spot hardly finds a clean place.
std::optional<FrontMeasurement> measure_front(const StepView& view) {
  const auto [riser, is_lip] = front_zone(view);
  std::optional<Front> front = riser.length() > 0.0 ? front_within(view, riser) : std::nullopt;
  double systematic = is_lip ? kMixedShare * view.spot_radius_m() + kUnclearLip * view.front_u() : 0.0;
  bool is_bar = is_lip;
  bool has_riser = true;
  if (!front || !fills(front->heights, riser)) {
    const std::optional<Front> bar = front_within(view, {-kBarHeight_m, 0.5 * view.spot_radius_m()});
    if (bar) {
      front = bar;
      is_bar = true;
      has_riser = false;
      systematic = kMixedShare * view.spot_radius_m();
    }
  }
  if (!front) return std::nullopt;
  const double sigma = std::hypot(view.options().range_sigma_m / std::sqrt(front->count()), systematic);
  FrontMeasurement measurement{.place = {front->value, sigma}, .turn = {}, .has_riser = has_riser, .is_bar = is_bar};
  if (front->variance_v > 0.0) measurement.turn = Estimate{front->turn, sigma / std::sqrt(front->variance_v)};
  return measurement;
}

}  // namespace stairway::detect
