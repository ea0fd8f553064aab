// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "detector/step_edges.hpp"

#include <algorithm>
#include <cmath>

#include "detector/edge_strips.hpp"
#include "detector/statistics.hpp"
#include "detector/step_line.hpp"
#include "detector/step_reaches.hpp"

namespace stairway::detect {
namespace {

constexpr double kColumn_m = 0.05;          // strips across the sides, for nosings
constexpr double kSightScatter_rad = 3e-4;  // by which beams leave edges elsewhere in their spot, from step to step

NosingSight sight_over(const StepView& view, double u, double z, double sigma_m, bool over_a_front) {
  NosingSight sight{.at = {u, view.sides().middle(), z}, .sigma_m = sigma_m, .over_a_front = over_a_front};
  if (view.sensor()) {
    const double length = std::hypot(u - view.sensor()->u, z - view.sensor()->z);
    sight.distance_m = std::hypot(length, view.sides().middle() - view.sensor()->v);
    sight.along_u = (u - view.sensor()->u) / length;
    sight.along_z = (z - view.sensor()->z) / length;
  }
  return sight;
}

std::optional<Estimate> top_of_front(const StepView& view, double front_u) {
  constexpr double kFloor_m = 3e-3;
  EdgeStrips strips(view.sides(), kColumn_m);
  for (const StepPoint& p : view.points())
    if (std::abs(p.u - front_u) <= view.reach_m() && std::abs(p.z) <= view.options().search_m)
      strips.add(p.v, {p.z, true});
  std::vector<EdgePlace> tops;
  for (const std::vector<Crossing>& strip : strips.strips()) {
    const auto top = std::max_element(strip.begin(), strip.end(),
                                      [](const Crossing& a, const Crossing& b) { return a.place < b.place; });
    if (top != strip.end()) tops.push_back({0.0, top->place});
  }
  return common_place(tops, kFloor_m);
}

}  // namespace

std::optional<NosingSight> nosing_over_front(const StepView& view, double front_u) {
  constexpr double kFloor_m = 3e-4;
  if (!view.sensor()) {
    const std::optional<Estimate> top = top_of_front(view, front_u);
    if (!top) return std::nullopt;
    NosingSight sight = sight_over(view, view.front_u(), top->value, top->sigma, true);
    sight.without_sight = true;
    return sight;
  }
  EdgeStrips strips(view.sides(), kColumn_m);
  for (const StepPoint& p : view.points()) {
    if (p.u < view.front_u() - view.options().search_m) continue;
    // There the range is half way to what lies behind.
    const StepPoint q = view.at_front(p);
    if (std::abs(q.z) <= kEdgeReach_m) strips.add(q.v, {q.z, p.u < view.front_u() + 0.5 * view.depth_at(p.v)});
  }
  const std::optional<Estimate> median_top = common_place(strips.edges(), kFloor_m);
  if (!median_top) return std::nullopt;
  const std::optional<Estimate> common_top = strips.edge();
  const Estimate top =
      common_top ? *common_top
                 : Estimate{median_top->value, std::hypot(median_top->sigma, strips.gap_sigma(median_top->value))};
  NosingSight sight = sight_over(view, view.front_u(), top.value, std::max(top.sigma, kFloor_m), true);
  sight.sigma_m = std::hypot(sight.sigma_m, kSightScatter_rad * sight.distance_m);
  sight.sigma_m *= std::abs(sight.along_u);
  return sight;
}

std::optional<EdgeMeasurement> nosing_over_tread(const StepView& view) {
  constexpr double kFloor_m = 3e-4;
  EdgeStrips strips(view.sides(), kColumn_m);
  for (const StepPoint& p : view.points()) {
    if (p.z > view.options().search_m) continue;
    const StepPoint q = view.at_tread(p);
    if (std::abs(q.u) <= kEdgeReach_m) strips.add(q.v, {-q.u, p.z > -0.5 * view.model().height_m});
  }
  const std::vector<EdgePlace> edges = strips.edges();
  const std::optional<Estimate> place = common_place(edges, kFloor_m);
  if (!place) return std::nullopt;
  StepLine line{.value = -place->value};
  std::vector<PlacePoint> points;
  for (const EdgePlace& e : edges) points.push_back({-e.place, e.v - view.sides().middle()});
  fit_line(points, line);
  double chi2 = 0.0;
  for (const auto& [u, v] : points) chi2 += std::pow(u - line.value - line.turn * v, 2);
  const double n = static_cast<double>(points.size());
  const double scatter = std::max(kFloor_m, std::sqrt(chi2 / std::max(1.0, n - 2.0) / n));
  const double sigma = std::hypot(scatter, strips.gap_sigma(place->value));
  EdgeMeasurement edge{.nosing = sight_over(view, line.value, 0.0, sigma, false), .turn = {}};
  edge.nosing.sigma_m *= std::abs(edge.nosing.along_z);
  if (line.variance_v > 0.0) edge.turn = Estimate{line.turn, sigma / std::sqrt(line.variance_v)};
  return edge;
}

}  // namespace stairway::detect
