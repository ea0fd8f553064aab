// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "detector/edge_strips.hpp"
#include "detector/statistics.hpp"
#include "detector/step_edges.hpp"
#include "detector/step_reaches.hpp"

namespace stairway::detect {
namespace {

constexpr double kRow_m = 0.02;  // strips across a face
constexpr double kHalfBeam_rad = 2.2e-3;
constexpr double kLipBand_m = 0.045;
constexpr double kLipRow_m = 0.011;

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
