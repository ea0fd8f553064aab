// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "detector/step_edges.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

#include "detector/sight_edge.hpp"
#include "detector/step_line.hpp"
#include "detector/step_reaches.hpp"

namespace stairway::detect {
namespace {

constexpr double kColumn_m = 0.05;  // strips across the sides, for nosings
constexpr double kRow_m = 0.02;     // strips across a face, for its ends

/// A place and the v at which it was found.
struct EdgePlace {
  double v = 0.0;
  double place = 0.0;
};

/// Strips of crossings side by side, each of which shows the same edge.
class EdgeStrips {
 public:
  EdgeStrips(const Interval& range, double strip_m)
      : range_(range), strips_(static_cast<std::size_t>(std::max(1.0, range.length() / strip_m))) {}

  void add(double position, const Crossing& crossing) {
    const double strip = (position - range_.low) / range_.length() * static_cast<double>(strips_.size());
    if (strip >= 0.0 && strip < static_cast<double>(strips_.size()))
      strips_[static_cast<std::size_t>(strip)].push_back(crossing);
  }

  std::vector<std::vector<Crossing>>& strips() { return strips_; }

  /// What the edge at `place` may be off by because no line of sight passes nearer: where beams cross all strips alike,
  /// all tell the same two places that the edge lies between.
  double gap_sigma(double place) const {
    double before = -kEdgeReach_m;
    double beyond = kEdgeReach_m;
    for (const std::vector<Crossing>& strip : strips_) {
      for (const Crossing& crossing : strip) {
        const double off = crossing.place - place;
        if (off < 0.0) {
          before = std::max(before, off);
        } else {
          beyond = std::min(beyond, off);
        }
      }
    }
    return (beyond - before) / std::sqrt(12.0);
  }

  std::vector<EdgePlace> edges() {
    std::vector<EdgePlace> found;
    for (std::size_t i = 0; i < strips_.size(); ++i) {
      const double middle =
          range_.low + (static_cast<double>(i) + 0.5) / static_cast<double>(strips_.size()) * range_.length();
      if (const std::optional<double> place = edge_between(strips_[i])) found.push_back({middle, *place});
    }
    return found;
  }

 private:
  Interval range_;
  std::vector<std::vector<Crossing>> strips_;
};

std::optional<Estimate> common_place(const std::vector<EdgePlace>& edges, double floor) {
  constexpr std::size_t kFewest = 3;
  if (edges.size() < kFewest) return std::nullopt;
  std::vector<double> places;
  for (const EdgePlace& edge : edges) places.push_back(edge.place);
  return robust_mean(places, floor);
}

NosingSight sight_over(const StepView& view, double u, double z, double sigma_m, bool over_a_front) {
  NosingSight sight{.at = {u, view.sides().middle(), z}, .sigma_m = sigma_m, .over_a_front = over_a_front};
  if (view.sensor()) {
    const double length = std::hypot(u - view.sensor()->u, z - view.sensor()->z);
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

/// A face of the step on which its ends are looked for, and how lines of sight cross it.
struct Face {
  Interval band;                                   ///< of the face that is looked at, across the ends [m]
  std::function<double(const StepPoint&)> place;   ///< in the band, where the line of sight to a point crosses it
  std::function<double(const StepPoint&)> side;    ///< and its v
  std::function<double(const StepPoint&)> beyond;  ///< how far the point lies behind the face [m]
  double reach;                                    ///< a point is on the face within this distance [m]
};

std::optional<Estimate> end_of(const StepView& view, const Face& face, double end) {
  const double outward = end > view.sides().middle() ? 1.0 : -1.0;
  const double inside = std::min(kEndReach_m, 0.5 * view.sides().length());
  if (!(face.band.length() > 0.0)) return std::nullopt;
  EdgeStrips rows(face.band, kRow_m);
  EdgeStrips hidden(face.band, kRow_m);
  for (const StepPoint& p : view.points()) {
    const double v = face.side(p);
    const double beyond_end = outward * (v - end);
    if (beyond_end < -inside || beyond_end > kEndReach_m) continue;
    const double beyond = face.beyond(p);
    if (beyond < -face.reach) {
      hidden.add(face.place(p), {outward * v, false});
    } else {
      // A wall beside the step is hit where the step ends, though the line of sight would cross the face beyond.
      const bool on = beyond < face.reach;
      rows.add(face.place(p), {outward * (on ? p.v : v), on});
    }
  }
  for (std::size_t i = 0; i < rows.strips().size(); ++i) {
    // A wall at the end of the face hides nothing: it is where the face ends.
    double outermost = outward * end - kEndReach_m;
    for (const Crossing& c : rows.strips()[i])
      if (c.on) outermost = std::max(outermost, c.place);
    for (const Crossing& c : hidden.strips()[i])
      if (c.place > outermost) rows.strips()[i].push_back(c);
  }
  constexpr double kFloor_m = 3e-4;
  std::optional<Estimate> place = common_place(rows.edges(), kFloor_m);
  if (!place) return std::nullopt;
  return Estimate{outward * place->value, std::hypot(place->sigma, rows.gap_sigma(place->value))};
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
  const std::optional<Estimate> top = common_place(strips.edges(), kFloor_m);
  if (!top) return std::nullopt;
  const double sigma = std::hypot(top->sigma, strips.gap_sigma(top->value));
  NosingSight sight = sight_over(view, view.front_u(), top->value, sigma, true);
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

std::optional<Estimate> end_of_front(const StepView& view, double end_v) {
  return end_of(view,
                {.band = {std::max(view.visible_bottom_m(), -kEndBand_m), 0.0},
                 .place = [&](const StepPoint& p) { return view.at_front(p).z; },
                 .side = [&](const StepPoint& p) { return view.at_front(p).v; },
                 .beyond = [&](const StepPoint& p) { return p.u - view.front_u(); },
                 .reach = kFrontReach_m},
                end_v);
}

std::optional<Estimate> end_of_tread(const StepView& view, double end_v) {
  return end_of(view,
                {.band = {0.0, std::min(kEndBand_m, 0.5 * view.model().depth_m)},
                 .place = [&](const StepPoint& p) { return view.at_tread(p).u; },
                 .side = [&](const StepPoint& p) { return view.at_tread(p).v; },
                 .beyond = [](const StepPoint& p) { return -p.z; },
                 .reach = view.reach_m()},
                end_v);
}

}  // namespace stairway::detect
