// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "detector/step_edges.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "detector/sight_edge.hpp"
#include "detector/statistics.hpp"
#include "detector/step_line.hpp"
#include "detector/step_reaches.hpp"

namespace stairway::detect {
namespace {

constexpr double kColumn_m = 0.05;          // strips across the sides, for nosings
constexpr double kRow_m = 0.02;             // strips across a face, for its ends
constexpr double kSightScatter_rad = 3e-4;  // by which beams leave edges elsewhere in their spot, from step to step
constexpr double kHalfBeam_rad = 2.2e-3;
constexpr double kLipBand_m = 0.045;
constexpr double kLipRow_m = 0.011;

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

  /// The edge that all strips tell together, closer than each alone: they cut it at different places.
  std::optional<Estimate> edge() const {
    std::vector<Crossing> all;
    for (const std::vector<Crossing>& strip : strips_) all.insert(all.end(), strip.begin(), strip.end());
    const std::optional<SightEdge> edge = edge_between(all);
    if (!edge) return std::nullopt;
    return Estimate{edge->place, edge->sigma};
  }

  std::vector<EdgePlace> edges() {
    std::vector<EdgePlace> found;
    for (std::size_t i = 0; i < strips_.size(); ++i) {
      const double middle =
          range_.low + (static_cast<double>(i) + 0.5) / static_cast<double>(strips_.size()) * range_.length();
      if (const std::optional<SightEdge> edge = edge_between(strips_[i])) found.push_back({middle, edge->place});
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

/// A face of the step on which its ends are looked for, and how lines of sight cross it.
struct Face {
  Interval band;                                   ///< of the face that is looked at, across the ends [m]
  std::function<double(const StepPoint&)> place;   ///< in the band, where the line of sight to a point crosses it
  std::function<double(const StepPoint&)> side;    ///< and its v
  std::function<double(const StepPoint&)> beyond;  ///< how far the point lies behind the face [m]
  double reach;                                    ///< a point is on the face within this distance [m]
  double row_m = kRow_m;                           ///< height of the strips it is cut into
};

// Where the first lines of sight pass freely beyond what is seen of the face, row by row; of a few the nearest.
std::optional<double> first_free(std::vector<std::vector<Crossing>>& rows) {
  std::vector<double> places;
  for (const std::vector<Crossing>& row : rows) {
    double outermost = std::numeric_limits<double>::lowest();
    for (const Crossing& c : row)
      if (c.on) outermost = std::max(outermost, c.place);
    double first = std::numeric_limits<double>::max();
    for (const Crossing& c : row)
      if (!c.on && c.place > outermost) first = std::min(first, c.place);
    if (outermost > std::numeric_limits<double>::lowest() && first < std::numeric_limits<double>::max())
      places.push_back(first);
  }
  if (places.empty()) return std::nullopt;
  return outer_quartile(places, false);
}

std::optional<EndMeasurement> end_of(const StepView& view, const Face& face, double end) {
  const double outward = end > view.sides().middle() ? 1.0 : -1.0;
  const double inside = std::min(kEndReach_m, 0.5 * view.sides().length());
  if (!(face.band.length() > 0.0)) return std::nullopt;
  EdgeStrips rows(face.band, face.row_m);
  EdgeStrips hidden(face.band, face.row_m);
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
  const std::optional<double> limit = first_free(rows.strips());
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
  EndMeasurement measured{.place = {outward * place->value, std::hypot(place->sigma, rows.gap_sigma(place->value))},
                          .limit = {}};
  // Free lines begin half a beam beyond the end, on average.
  if (limit)
    measured.limit = outward * (*limit - kHalfBeam_rad * view.spot_radius_m() / (0.5 * view.options().spot_rad));
  return measured;
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

namespace {

// A sensor that stands beside the flight sees its flank, on which the end lies wherever the line of sight meets it.
std::optional<Estimate> end_by_flank(const StepView& view, double end_v) {
  constexpr double kBeside_m = 0.1;
  constexpr double kInwards_m = 0.06;  // stringers stand farther in
  constexpr double kOutwards_m = 0.4;
  constexpr double kBelow_m = 0.02;
  constexpr double kFloor_m = 5e-4;
  const double outward = end_v > view.sides().middle() ? 1.0 : -1.0;
  if (outward * (view.sensor()->v - end_v) < kBeside_m) return std::nullopt;
  std::vector<double> places;
  for (const StepPoint& p : view.points()) {
    const bool is_beside_step = p.u > view.front_u() + kBelow_m && p.u < 0.8 * view.model().depth_m &&
                                p.z < -kBelow_m && p.z > -view.model().height_m;
    const double beyond_end = outward * (p.v - end_v);
    if (is_beside_step && beyond_end > -kInwards_m && beyond_end < kOutwards_m) places.push_back(p.v);
  }
  if (!view.are_enough(places.size())) return std::nullopt;
  std::sort(places.begin(), places.end());
  const double center = densest_place(places, view.reach_m());
  std::vector<double> near;
  for (const double place : places)
    if (std::abs(place - center) <= view.reach_m()) near.push_back(place);
  const double fair = static_cast<double>(places.size()) * 2.0 * view.reach_m() / (kInwards_m + kOutwards_m);
  if (!view.are_enough(near.size()) || static_cast<double>(near.size()) < view.options().min_contrast * fair)
    return std::nullopt;
  return robust_mean(near, kFloor_m);
}

}  // namespace

std::optional<EndMeasurement> end_of_front(const StepView& view, double end_v) {
  if (const std::optional<Estimate> flank = end_by_flank(view, end_v))
    return EndMeasurement{.place = *flank, .limit = {}};
  // The ends of a lip that stands out are seen elsewhere than those of the front behind it.
  const double u = view.has_lip() ? 0.0 : view.front_u();
  const double band = view.has_lip() ? kLipBand_m : kEndBand_m;
  return end_of(view,
                {.band = {std::max(view.visible_bottom_m(), -band), 0.0},
                 .place = [&](const StepPoint& p) { return view.at_upright(p, u).z; },
                 .side = [&](const StepPoint& p) { return view.at_upright(p, u).v; },
                 .beyond = [&](const StepPoint& p) { return p.u - u; },
                 .reach = kFrontReach_m,
                 .row_m = view.has_lip() ? kLipRow_m : kRow_m},
                end_v);
}

std::optional<EndMeasurement> end_of_tread(const StepView& view, double end_v) {
  return end_of(view,
                {.band = {0.0, std::min(kEndBand_m, 0.5 * view.model().depth_m)},
                 .place = [&](const StepPoint& p) { return view.at_tread(p).u; },
                 .side = [&](const StepPoint& p) { return view.at_tread(p).v; },
                 .beyond = [](const StepPoint& p) { return -p.z; },
                 .reach = view.reach_m()},
                end_v);
}

}  // namespace stairway::detect
