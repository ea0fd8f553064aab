// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "detector/step_measurement.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <vector>

#include "detector/sight_edge.hpp"
#include "detector/statistics.hpp"

namespace stairway::detect {
namespace {

constexpr double kStrip_m = 0.10;       // for coverage
constexpr double kColumn_m = 0.05;      // for edges
constexpr double kRow_m = 0.02;         // likewise, for the ends of the stairway
constexpr double kEdgeReach_m = 0.09;   // an edge is looked for this far from its place
constexpr double kEndReach_m = 0.4;     // likewise for the ends
constexpr double kEndBand_m = 0.10;     // they are measured on this much of the front, below its top
constexpr double kBarHeight_m = 0.05;   // the front of an open tread lies within this below its nosing
constexpr double kMixedShare = 0.25;    // of the spot's radius, what mixed pixels may shift such a front by
constexpr double kFrontReach_m = 0.07;  // a point is on a front within this distance
constexpr double kThinnestTread_m = 0.015;
constexpr double kThickestTread_m = 0.12;
constexpr double kTreadMargin = 0.2;  // share of a tread at its front and back that is not measured
constexpr double kLandingNear =
    0.7;                             // a landing goes on this share of a depth before a nosing, where no tread reaches,
constexpr double kLandingFar = 1.5;  // and at least to here
constexpr double kClearance_m = 0.03;  // the sensor must lie this far before a front, or above a tread, to see it

double square(double value) { return value * value; }

/// Median and its standard error from the median absolute deviation, not below `floor`.
Estimate robust_mean(const std::vector<double>& values, double floor) {
  const double middle = median(values);
  const double scatter = robust_deviation(values, middle);
  return {middle, std::max(floor, 1.2533 * scatter / std::sqrt(static_cast<double>(values.size())))};
}

/// Where the densest window of half-width `reach` among sorted values is centred.
double densest(const std::vector<double>& sorted, double reach) {
  std::size_t best_begin = 0;
  std::size_t best_count = 0;
  for (std::size_t begin = 0, end = 0; begin < sorted.size(); ++begin) {
    while (end < sorted.size() && sorted[end] - sorted[begin] <= 2.0 * reach) ++end;
    if (end - begin > best_count) {
      best_count = end - begin;
      best_begin = begin;
    }
  }
  const auto begin = sorted.begin() + static_cast<std::ptrdiff_t>(best_begin);
  return median({begin, begin + static_cast<std::ptrdiff_t>(best_count)});
}

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

/// A straight line u = value + turn v and what is known of it.
struct Line {
  double value = 0.0;
  double turn = 0.0;
  double variance_v = 0.0;
  double mean_v = 0.0;
};

/// Least squares; the line keeps its slope when the points have no width.
template <typename Points>
void fit_line(const Points& points, Line& line) {
  double n = 0.0, sum_u = 0.0, sum_v = 0.0, sum_uv = 0.0, sum_vv = 0.0;
  for (const auto& [u, v] : points) {
    const double off = u - line.value;
    n += 1.0;
    sum_u += off;
    sum_v += v;
    sum_uv += off * v;
    sum_vv += v * v;
  }
  if (n < 2.0) return;
  line.mean_v = sum_v / n;
  line.variance_v = sum_vv / n - square(line.mean_v);
  if (line.variance_v > 0.0) line.turn = (sum_uv / n - sum_u / n * line.mean_v) / line.variance_v;
  line.value += sum_u / n - line.turn * line.mean_v;
}

/// Measures one step from the points near it.
class StepSurvey {
 public:
  StepSurvey(const StairCorridor& corridor, const StairModel& model, const Interval& sides, int number,
             const StepMeasurementOptions& options)
      : model_(model),
        sides_(sides),
        options_(options),
        reach_(2.5 * options.range_sigma_m),
        front_u_(model.overhang_m) {
    result_.number = number;
    result_.middle_v = sides.middle();
    result_.frame = model.step(number);
    if (corridor.sensor()) sensor_ = result_.frame.to_step(*corridor.sensor());
    const StepFrame next = model.step(number + 1);
    next_ = result_.frame.to_step(next.nosing);
    next_slope_ = next.left().dot(-result_.frame.descent) / next.left().dot(result_.frame.left());
    pick(corridor.points());
  }

  StepMeasurement measure() {
    if (faces_front()) measure_front();
    if (!sensor_ || sensor_->z > 0.0) measure_level(-options_.search_m, options_.search_m, result_.surface);
    if (!sensor_ || sensor_->z < 0.0) measure_level(-kThickestTread_m, -kThinnestTread_m, result_.underside);
    result_.is_landing = result_.surface && goes_on_before();
    if (result_.front) {
      measure_nosing();
      if (sensor_) {
        result_.right_end = measure_end(sides_.low, fronts());
        result_.left_end = measure_end(sides_.high, fronts());
      }
    } else if (sees_edge_from_behind()) {
      measure_edge();
      result_.right_end = measure_end(sides_.low, treads_seen_from_behind());
      result_.left_end = measure_end(sides_.high, treads_seen_from_behind());
    }
    if (model_.is_spiral()) measure_inner_end();
    return result_;
  }

 private:
  bool faces_front() const { return !sensor_ || sensor_->u < front_u_ - kClearance_m; }
  bool sees_edge_from_behind() const {
    return sensor_ && sensor_->u > kClearance_m && sensor_->z > kClearance_m && result_.surface;
  }

  bool looks_down_from_behind() const {
    return sensor_ && sensor_->u > model_.depth_m + kClearance_m && sensor_->z > kClearance_m;
  }

  // The next nosing, which on a spiral is turned against this one.
  double depth_at(double v) const { return next_.u + (v - next_.v) * next_slope_; }

  void pick(const std::vector<Eigen::Vector3d>& points) {
    const double margin = 2.0 * options_.search_m;
    const double low_v = sides_.low - kEndReach_m;
    const double high_v = sides_.high + kEndReach_m;
    const auto is_near = [&](double v, double z) {
      return v > low_v && v < high_v && z > -model_.height_m - margin && z < margin;
    };
    for (const Eigen::Vector3d& point : points) {
      const StepPoint p = result_.frame.to_step(point);
      const double first_u = std::abs(p.z) < margin ? -kLandingFar * model_.depth_m : front_u_ - margin;
      bool picked = is_near(p.v, p.z) && p.u > first_u && p.u < depth_at(p.v);
      if (!picked && sensor_ && faces_front() && p.u > sensor_->u + kClearance_m) {
        const StepPoint q = at_front(p);
        picked = is_near(q.v, q.z);
      }
      if (!picked && sensor_ && sensor_->z > p.z + kClearance_m && sensor_->z > kClearance_m) {
        const StepPoint q = at_tread(p);
        picked = q.u > -margin && q.u < std::max(margin, kEndBand_m) && q.v > low_v && q.v < high_v;
      }
      if (picked) points_.push_back(p);
    }
  }

  // Where the line of sight to a point passes the plane of the front. Without a sensor the point itself.
  StepPoint at_front(const StepPoint& p) const {
    if (!sensor_) return p;
    const double share = (front_u_ - sensor_->u) / std::max(p.u - sensor_->u, 1e-3);
    return {front_u_, sensor_->v + (p.v - sensor_->v) * share, sensor_->z + (p.z - sensor_->z) * share};
  }

  // Likewise the plane of the tread, for a sensor above it.
  StepPoint at_tread(const StepPoint& p) const {
    const double share = sensor_->z / std::max(sensor_->z - p.z, 1e-3);
    return {sensor_->u + (p.u - sensor_->u) * share, sensor_->v + (p.v - sensor_->v) * share, 0.0};
  }

  // Half the width of the beam's spot at the nosing.
  double spot_radius() const {
    if (!sensor_) return 0.0;
    return 0.5 * options_.spot_rad * std::hypot(front_u_ - sensor_->u, sides_.middle() - sensor_->v, sensor_->z);
  }

  // The lowest height of the front that the nosing below lets one see.
  double visible_bottom() const {
    const double below = -model_.height_m;
    if (!sensor_ || sensor_->z >= below) return below;
    const double nosing_u = front_u_ - model_.depth_m;
    if (sensor_->u > nosing_u - kClearance_m) return below;
    return std::min(sensor_->z + (below - sensor_->z) * (front_u_ - sensor_->u) / (nosing_u - sensor_->u), 0.0);
  }

  bool covers(const std::vector<double>& places) const {
    const auto strips = static_cast<std::size_t>(std::max(1.0, std::floor(sides_.length() / kStrip_m)));
    std::vector<bool> hit(strips, false);
    for (const double v : places) {
      const auto strip = static_cast<std::ptrdiff_t>((v - sides_.low) / sides_.length() * static_cast<double>(strips));
      if (strip >= 0 && strip < static_cast<std::ptrdiff_t>(strips)) hit[static_cast<std::size_t>(strip)] = true;
    }
    return static_cast<double>(std::count(hit.begin(), hit.end(), true)) >=
           options_.min_coverage * static_cast<double>(strips);
  }

  static bool fills(const std::vector<double>& heights, const Interval& zone) {
    constexpr std::size_t kRows = 4;
    constexpr double kFairShare = 0.3;
    std::array<std::size_t, kRows> rows{};
    for (const double z : heights)
      ++rows[std::min(kRows - 1,
                      static_cast<std::size_t>((z - zone.low) / zone.length() * static_cast<double>(kRows)))];
    const double fair = kFairShare * static_cast<double>(heights.size()) / static_cast<double>(kRows);
    return std::all_of(rows.begin(), rows.end(), [&](std::size_t n) { return static_cast<double>(n) >= fair; });
  }

  bool beside_middle(const StepPoint& p) const { return p.v >= sides_.low && p.v <= sides_.high; }

  /// Points of a front and the straight line through them; v from the middle of the sides.
  struct Front : Line {
    std::vector<double> places;
    std::vector<double> heights;
    double count() const { return static_cast<double>(heights.size()); }
  };

  std::optional<Front> front_within(const Interval& zone) const {
    std::vector<StepPoint> near;
    std::size_t behind = 0;
    for (const StepPoint& p : points_) {
      const double depth = p.u - front_u_;
      const double next = depth_at(p.v);
      if (depth < -2.0 * options_.search_m || depth > next || !beside_middle(p)) continue;
      const double z = at_front(p).z;
      if (z < zone.low || z > zone.high) continue;
      if (std::abs(depth) < 2.0 * options_.search_m) near.push_back({p.u, p.v, z});
      if (depth > options_.search_m && depth < next - options_.search_m) ++behind;
    }
    std::vector<double> places;
    for (const StepPoint& p : near)
      if (std::abs(p.u - front_u_) < options_.search_m) places.push_back(p.u);
    if (places.size() < static_cast<std::size_t>(options_.min_points)) return std::nullopt;
    std::sort(places.begin(), places.end());

    Front front;
    front.value = densest(places, reach_);
    constexpr int kPasses = 2;  // the second follows the slope that the first has found
    for (int pass = 0; pass < kPasses; ++pass) follow(near, front);
    if (front.heights.size() < static_cast<std::size_t>(options_.min_points)) return std::nullopt;
    const double free_depth = std::max(model_.depth_m - 2.0 * options_.search_m, 0.01);
    const double contrast = front.count() / (2.0 * reach_) / std::max(static_cast<double>(behind) / free_depth, 1e-9);
    if (contrast < options_.min_contrast || !covers(front.places)) return std::nullopt;
    return front;
  }

  void follow(const std::vector<StepPoint>& points, Front& front) const {
    std::vector<std::pair<double, double>> line;
    front.places.clear();
    front.heights.clear();
    for (const StepPoint& p : points) {
      const double v = p.v - sides_.middle();
      if (std::abs(p.u - front.value - front.turn * v) > reach_) continue;
      line.emplace_back(p.u, v);
      front.places.push_back(p.v);
      front.heights.push_back(p.z);
    }
    fit_line(line, front);
  }

  // A riser is seen clean where the whole spot lies on it. Where none is filled with points, the front of an open tread
  // may be: a bar in which the spot hardly finds a clean place.
  void measure_front() {
    const double bottom = visible_bottom();
    const double margin = std::min(spot_radius(), -0.25 * bottom);
    const Interval riser{bottom + margin, -margin};
    std::optional<Front> front = riser.length() > 0.0 ? front_within(riser) : std::nullopt;
    double systematic = 0.0;
    if (!front || !fills(front->heights, riser)) {
      const std::optional<Front> bar = front_within({-kBarHeight_m, 0.5 * spot_radius()});
      if (bar) {
        front = bar;
        systematic = kMixedShare * spot_radius();
      }
    }
    if (!front) return;
    const double sigma = std::hypot(options_.range_sigma_m / std::sqrt(front->count()), systematic);
    result_.front = Estimate{front->value, sigma};
    if (front->variance_v > 0.0) result_.turn = Estimate{front->turn, sigma / std::sqrt(front->variance_v)};
  }

  // Clear of the edges. From behind one looks over the next nosing, whose edge mixes with what lies below it.
  bool lies_on_tread(const StepPoint& p) const {
    const double depth = depth_at(p.v);
    const double margin = kTreadMargin * depth;
    if (!looks_down_from_behind()) return p.u > front_u_ + margin && p.u < front_u_ + depth - margin;
    const double slope = (sensor_->z - p.z) / (sensor_->u - p.u);
    const double over_next = p.z + (depth - p.u) * slope - model_.height_m;
    const double over_nosing = p.z - p.u * slope;
    const double spot = spot_radius() * std::hypot(1.0, slope);
    return p.u < depth && over_next > spot && over_nosing < -spot;
  }

  void measure_level(double low, double high, std::optional<Estimate>& level) const {
    std::vector<double> heights;
    std::vector<double> places;
    for (const StepPoint& p : points_) {
      if (p.z < low || p.z > high || !beside_middle(p) || !lies_on_tread(p)) continue;
      heights.push_back(p.z);
      places.push_back(p.v);
    }
    if (heights.size() < static_cast<std::size_t>(options_.min_points) || !covers(places)) return;
    std::vector<double> sorted = heights;
    std::sort(sorted.begin(), sorted.end());
    const double center = densest(sorted, reach_);
    std::vector<double> near;
    for (const double height : heights)
      if (std::abs(height - center) <= reach_) near.push_back(height);
    const double off = static_cast<double>(heights.size() - near.size());
    const double fair = off * 2.0 * reach_ / std::max(high - low - 2.0 * reach_, 0.01);
    if (static_cast<double>(near.size()) < options_.min_contrast * fair ||
        near.size() < static_cast<std::size_t>(options_.min_points))
      return;
    constexpr double kFloor_m = 1e-4;
    level = robust_mean(near, kFloor_m);
  }

  // At the height of a tread there is nothing before its nosing.
  bool goes_on_before() const {
    const double near = -kLandingNear * model_.depth_m;
    const double far = -kLandingFar * model_.depth_m;
    std::vector<double> places;
    for (const StepPoint& p : points_)
      if (p.u > far && p.u < near && beside_middle(p) && std::abs(p.z - result_.surface->value) < reach_)
        places.push_back(p.v);
    return places.size() >= static_cast<std::size_t>(options_.min_points) && covers(places);
  }

  NosingSight sight_over(double u, double z, double sigma_m, bool over_a_front) const {
    NosingSight sight{.at = {u, sides_.middle(), z}, .sigma_m = sigma_m, .over_a_front = over_a_front};
    if (sensor_) {
      const double length = std::hypot(u - sensor_->u, z - sensor_->z);
      sight.along_u = (u - sensor_->u) / length;
      sight.along_z = (z - sensor_->z) / length;
    }
    return sight;
  }

  // The line of sight leaves the front where half the spot does: there the range is half way to what lies behind.
  void measure_nosing() {
    constexpr double kFloor_m = 3e-4;
    if (!sensor_) {
      if (const std::optional<Estimate> top = top_of_front())
        result_.nosing = sight_over(front_u_, top->value, top->sigma, true);
      if (result_.nosing) result_.nosing->without_sight = true;
      return;
    }
    EdgeStrips strips(sides_, kColumn_m);
    for (const StepPoint& p : points_) {
      if (p.u < front_u_ - options_.search_m) continue;
      const StepPoint q = at_front(p);
      if (std::abs(q.z) <= kEdgeReach_m) strips.add(q.v, {q.z, p.u < front_u_ + 0.5 * depth_at(p.v)});
    }
    const std::optional<Estimate> top = common_place(strips.edges(), kFloor_m);
    if (!top) return;
    result_.nosing = sight_over(front_u_, top->value, top->sigma, true);
    result_.nosing->sigma_m *= std::abs(result_.nosing->along_u);
  }

  // Without a line of sight the highest points of the front have to do.
  std::optional<Estimate> top_of_front() const {
    constexpr double kFloor_m = 3e-3;
    EdgeStrips strips(sides_, kColumn_m);
    for (const StepPoint& p : points_)
      if (std::abs(p.u - result_.front->value) <= reach_ && std::abs(p.z) <= options_.search_m)
        strips.add(p.v, {p.z, true});
    std::vector<EdgePlace> tops;
    for (const std::vector<Crossing>& strip : strips.strips()) {
      const auto top = std::max_element(strip.begin(), strip.end(),
                                        [](const Crossing& a, const Crossing& b) { return a.place < b.place; });
      if (top != strip.end()) tops.push_back({0.0, top->place});
    }
    return common_place(tops, kFloor_m);
  }

  // Seen from behind and above, the line of sight leaves the tread at its nosing, and ends on what lies below.
  void measure_edge() {
    constexpr double kFloor_m = 3e-4;
    EdgeStrips strips(sides_, kColumn_m);
    for (const StepPoint& p : points_) {
      if (p.z > options_.search_m) continue;
      const StepPoint q = at_tread(p);
      if (std::abs(q.u) <= kEdgeReach_m) strips.add(q.v, {-q.u, p.z > -0.5 * model_.height_m});
    }
    const std::vector<EdgePlace> edges = strips.edges();
    const std::optional<Estimate> place = common_place(edges, kFloor_m);
    if (!place) return;
    Line line{.value = -place->value};
    std::vector<std::pair<double, double>> points;
    for (const EdgePlace& edge : edges) points.emplace_back(-edge.place, edge.v - sides_.middle());
    fit_line(points, line);
    double chi2 = 0.0;
    for (const auto& [u, v] : points) chi2 += square(u - line.value - line.turn * v);
    const double n = static_cast<double>(points.size());
    const double sigma = std::max(kFloor_m, std::sqrt(chi2 / std::max(1.0, n - 2.0) / n));
    result_.nosing = sight_over(line.value, 0.0, sigma, false);
    result_.nosing->sigma_m *= std::abs(result_.nosing->along_z);
    if (line.variance_v > 0.0) result_.turn = Estimate{line.turn, sigma / std::sqrt(line.variance_v)};
  }

  /// A face of the step on which its ends are looked for, and how lines of sight cross it.
  struct Face {
    Interval band;                                   ///< of the face that is looked at, across the ends [m]
    std::function<double(const StepPoint&)> place;   ///< in the band, where the line of sight to a point crosses it
    std::function<double(const StepPoint&)> side;    ///< and its v
    std::function<double(const StepPoint&)> beyond;  ///< how far the point lies behind the face [m]
    double reach;                                    ///< a point is on the face within this distance [m]
  };

  Face fronts() const {
    return {.band = {std::max(visible_bottom(), -kEndBand_m), 0.0},
            .place = [this](const StepPoint& p) { return at_front(p).z; },
            .side = [this](const StepPoint& p) { return at_front(p).v; },
            .beyond = [this](const StepPoint& p) { return p.u - front_u_; },
            .reach = kFrontReach_m};
  }

  Face treads_seen_from_behind() const {
    return {.band = {0.0, std::min(kEndBand_m, 0.5 * model_.depth_m)},
            .place = [this](const StepPoint& p) { return at_tread(p).u; },
            .side = [this](const StepPoint& p) { return at_tread(p).v; },
            .beyond = [](const StepPoint& p) { return -p.z; },
            .reach = reach_};
  }

  // Like the nosing, but what stands in the way of the face (a post, a bystander) says nothing about its end.
  std::optional<Estimate> measure_end(double end, const Face& face) const {
    const double outward = end > sides_.middle() ? 1.0 : -1.0;
    const double inside = std::min(kEndReach_m, 0.5 * sides_.length());
    if (!(face.band.length() > 0.0)) return std::nullopt;
    EdgeStrips rows(face.band, kRow_m);
    EdgeStrips hidden(face.band, kRow_m);
    for (const StepPoint& p : points_) {
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
    if (place) place->value *= outward;
    return place;
  }

  // Beyond the inner end of a spiral's step lines of sight meet its other steps, so where the step's own points thin
  // out has to do.
  void measure_inner_end() {
    const bool to_left = model_.turn_rad > 0.0;
    std::optional<Estimate>& end = to_left ? result_.left_end : result_.right_end;
    end.reset();
    if (result_.underside) end = end_of_level(result_.underside->value, to_left);
    if (!end && result_.surface) end = end_of_level(result_.surface->value, to_left);
  }

  std::optional<Estimate> end_of_level(double level, bool to_left) const {
    constexpr double kBin_m = 0.02;
    constexpr double kThin = 0.5;
    constexpr double kSigma_m = 0.01;
    const double sign = to_left ? 1.0 : -1.0;
    const double middle = sides_.middle();
    const double to_axis = std::abs(model_.radius_m()) + sign * middle;
    std::vector<double> densities(static_cast<std::size_t>(std::max(2.0, to_axis / kBin_m)), 0.0);
    for (const StepPoint& p : points_) {
      const double out = sign * (p.v - middle);
      const double depth = depth_at(p.v);
      if (out < 0.0 || depth < kBin_m || std::abs(p.z - level) > reach_ || p.u < 0.0 || p.u > depth) continue;
      const auto bin = static_cast<std::size_t>(out / kBin_m);
      if (bin < densities.size()) densities[bin] += 1.0 / depth;
    }
    const auto half_way = densities.begin() + static_cast<std::ptrdiff_t>((densities.size() + 1) / 2);
    const double thin = kThin * median({densities.begin(), half_way});
    for (std::size_t bin = 1; bin + 1 < densities.size(); ++bin) {
      if (densities[bin] >= thin || densities[bin + 1] >= thin) continue;
      const double share = (densities[bin - 1] - thin) / (densities[bin - 1] - densities[bin]);
      return Estimate{middle + sign * (static_cast<double>(bin) - 0.5 + std::clamp(share, 0.0, 1.0)) * kBin_m,
                      kSigma_m};
    }
    return std::nullopt;
  }

  const StairModel& model_;
  const Interval sides_;
  const StepMeasurementOptions& options_;
  const double reach_;
  const double front_u_;
  std::optional<StepPoint> sensor_;
  StepPoint next_;
  double next_slope_ = 0.0;
  std::vector<StepPoint> points_;
  StepMeasurement result_;
};

}  // namespace

int StepMeasurement::count() const {
  return static_cast<int>(front.has_value()) + static_cast<int>(surface.has_value()) +
         static_cast<int>(underside.has_value());
}

std::string StepMeasurementOptions::problem() const {
  if (!(range_sigma_m > 0.0)) return "range_sigma_m must be greater than 0";
  if (!(spot_rad >= 0.0)) return "spot must not be negative";
  if (!(search_m > 0.0)) return "search_m must be greater than 0";
  if (min_points < 3) return "min_points must be at least 3";
  return {};
}

StepMeasurement measure_step(const StairCorridor& corridor, const StairModel& model, const Interval& sides, int number,
                             const StepMeasurementOptions& options) {
  return StepSurvey(corridor, model, sides, number, options).measure();
}

}  // namespace stairway::detect
