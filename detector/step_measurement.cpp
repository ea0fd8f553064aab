// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "detector/step_measurement.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

namespace stairway::detect {
namespace {

constexpr double kStrip_m = 0.10;       // for coverage
constexpr double kColumn_m = 0.05;      // for edges
constexpr double kEdgeReach_m = 0.09;   // an edge is looked for this far from its place
constexpr double kEndReach_m = 0.4;     // likewise for the ends of the stairway
constexpr double kBarHeight_m = 0.05;   // the front of an open tread lies within this below its nosing
constexpr double kMixedShare = 0.25;    // of the spot's radius, what mixed pixels may shift such a front by
constexpr double kFrontReach_m = 0.07;  // a point is on a front within this distance
constexpr double kFarthestBehind_m = 30.0;

/// A point in the axes of the model.
struct StairPoint {
  double u;
  double v;
  double z;
};

struct StairAxes {
  Eigen::Vector3d ascent;
  Eigen::Vector3d left;
  explicit StairAxes(const StairModel& model) : ascent(-model.descent), left(model.step(0).left()) {}
  StairPoint operator()(const Eigen::Vector3d& p) const { return {p.dot(ascent), p.dot(left), p.z()}; }
};

double square(double value) { return value * value; }

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// Median and its standard error from the median absolute deviation, not below `floor`.
Estimate robust_mean(const std::vector<double>& values, double floor) {
  const double middle = median(values);
  std::vector<double> off;
  off.reserve(values.size());
  for (const double value : values) off.push_back(std::abs(value - middle));
  const double scatter = 1.4826 * median(std::move(off));
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
  return median({sorted.begin() + static_cast<std::ptrdiff_t>(best_begin),
                 sorted.begin() + static_cast<std::ptrdiff_t>(best_begin + best_count)});
}

/// Measures one step from the points near it.
class StepSurvey {
 public:
  StepSurvey(const StairModel& model, const Interval& side, int number, const std::vector<StairPoint>& points,
             const std::optional<StairPoint>& sensor, const StepMeasurementOptions& options)
      : model_(model), side_(side), points_(points), sensor_(sensor), options_(options) {
    const StairAxes axes(model);
    const StairPoint nosing = axes(model.step(number).nosing);
    front_u_ = nosing.u + model.overhang_m;
    top_z_ = nosing.z;
    reach_ = 2.5 * options.range_sigma_m;
    result_.number = number;
  }

  StepMeasurement measure() {
    measure_front();
    if (!sensor_ || sensor_->z > top_z_)
      measure_level(top_z_ - options_.search_m, top_z_ + options_.search_m, result_.surface);
    if (!sensor_ || sensor_->z < top_z_) measure_level(top_z_ - 0.12, top_z_ - 0.015, result_.underside);
    if (result_.front) {
      measure_nosing();
      if (sensor_) {
        result_.right_end = measure_end(side_.low);
        result_.left_end = measure_end(side_.high);
      }
    }
    return result_;
  }

 private:
  // Where the ray through a point passes the plane of the front. Without a sensor the point itself.
  StairPoint at_front(const StairPoint& p) const {
    if (!sensor_) return p;
    const double share = (front_u_ - sensor_->u) / (p.u - sensor_->u);
    return {front_u_, sensor_->v + (p.v - sensor_->v) * share, sensor_->z + (p.z - sensor_->z) * share};
  }

  // Half the width of the beam's spot at the front.
  double spot_radius() const {
    if (!sensor_) return 0.0;
    const double range = std::hypot(front_u_ - sensor_->u, side_.middle() - sensor_->v, top_z_ - sensor_->z);
    return 0.5 * options_.spot_rad * range;
  }

  // The lowest height of the front that the nosing below lets one see.
  double visible_bottom() const {
    const double below = top_z_ - model_.height_m;
    if (!sensor_ || sensor_->z >= below) return below;
    const double nosing_u = front_u_ - model_.depth_m;
    return sensor_->z + (below - sensor_->z) * (front_u_ - sensor_->u) / (nosing_u - sensor_->u);
  }

  bool covers(const std::vector<double>& sides) const {
    const auto strips = static_cast<std::size_t>(std::max(1.0, std::floor(side_.length() / kStrip_m)));
    std::vector<bool> hit(strips, false);
    for (const double v : sides) {
      const auto strip = static_cast<std::ptrdiff_t>((v - side_.low) / side_.length() * static_cast<double>(strips));
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

  /// Points of a front and the straight line u = value + turn (v - middle) through them.
  struct Front {
    double value = 0.0;
    double turn = 0.0;
    double variance_v = 0.0;
    std::vector<double> sides;
    std::vector<double> heights;
    double count() const { return static_cast<double>(heights.size()); }
  };

  bool in_zone(const StairPoint& p, const Interval& zone) const {
    if (p.v < side_.low || p.v > side_.high) return false;
    const double z = at_front(p).z;
    return z >= zone.low && z <= zone.high;
  }

  std::optional<Front> front_within(const Interval& zone) const {
    std::vector<StairPoint> near;
    std::size_t behind = 0;
    for (const StairPoint& p : points_) {
      const double depth = p.u - front_u_;
      if (depth < -2.0 * options_.search_m || depth > model_.depth_m || !in_zone(p, zone)) continue;
      if (std::abs(depth) < 2.0 * options_.search_m) near.push_back({p.u, p.v, at_front(p).z});
      if (depth > options_.search_m && depth < model_.depth_m - options_.search_m) ++behind;
    }
    std::vector<double> places;
    for (const StairPoint& p : near)
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
    if (contrast < options_.min_contrast || !covers(front.sides)) return std::nullopt;
    return front;
  }

  // Fits the line to the points within reach of it.
  void follow(const std::vector<StairPoint>& points, Front& front) const {
    double sum_u = 0.0;
    double sum_v = 0.0;
    double sum_uv = 0.0;
    double sum_vv = 0.0;
    front.sides.clear();
    front.heights.clear();
    for (const StairPoint& p : points) {
      const double v = p.v - side_.middle();
      const double u = p.u - front.value;
      if (std::abs(u - front.turn * v) > reach_) continue;
      sum_u += u;
      sum_v += v;
      sum_uv += u * v;
      sum_vv += v * v;
      front.sides.push_back(p.v);
      front.heights.push_back(p.z);
    }
    const double n = front.count();
    if (n < 2.0) return;
    front.variance_v = sum_vv / n - square(sum_v / n);
    front.turn = front.variance_v > 0.0 ? (sum_uv / n - sum_u * sum_v / square(n)) / front.variance_v : 0.0;
    front.value += sum_u / n - front.turn * sum_v / n;
  }

  // A riser is seen clean where the whole spot lies on it. Where none is filled with points, the front of an open tread
  // may be: a bar in which the spot hardly finds a clean place.
  void measure_front() {
    const double bottom = visible_bottom();
    const double margin = std::min(spot_radius(), 0.25 * (top_z_ - bottom));
    const Interval riser{bottom + margin, top_z_ - margin};
    std::optional<Front> front = front_within(riser);
    double sigma = options_.range_sigma_m;
    double systematic = 0.0;
    if (!front || !fills(front->heights, riser)) {
      const std::optional<Front> bar = front_within({top_z_ - kBarHeight_m, top_z_ + 0.5 * spot_radius()});
      if (bar) {
        front = bar;
        systematic = kMixedShare * spot_radius();
      }
    }
    if (!front) return;
    sigma = std::hypot(sigma / std::sqrt(front->count()), systematic);
    result_.front = Estimate{front->value, sigma};
    if (front->variance_v > 0.0) result_.turn = Estimate{front->turn, sigma / std::sqrt(front->variance_v)};
  }

  void measure_level(double low, double high, std::optional<Estimate>& level) const {
    std::vector<double> heights;
    std::vector<double> sides;
    const double margin = 0.2 * model_.depth_m;
    for (const StairPoint& p : points_) {
      if (p.z < low || p.z > high || p.v < side_.low || p.v > side_.high || p.u < front_u_ + margin ||
          p.u > front_u_ + model_.depth_m - margin)
        continue;
      heights.push_back(p.z);
      sides.push_back(p.v);
    }
    if (heights.size() < static_cast<std::size_t>(options_.min_points) || !covers(sides)) return;
    std::vector<double> sorted = heights;
    std::sort(sorted.begin(), sorted.end());
    const double center = densest(sorted, reach_);
    std::vector<double> near;
    sides.clear();
    for (std::size_t i = 0; i < heights.size(); ++i) {
      if (std::abs(heights[i] - center) <= reach_) near.push_back(heights[i]);
    }
    const double off = static_cast<double>(heights.size() - near.size());
    if (static_cast<double>(near.size()) < options_.min_contrast * off * 2.0 * reach_ / (high - low - 2.0 * reach_))
      return;
    if (near.size() < static_cast<std::size_t>(options_.min_points)) return;
    level = robust_mean(near, 1e-4);
  }

  // Splits values that should be "on" below and "off" above some place so that the fewest lie on the wrong side.
  struct Crossing {
    double place;
    bool on;
  };
  static std::optional<double> best_split(std::vector<Crossing>& column) {
    constexpr std::size_t kMinPerColumn = 4;
    if (column.size() < kMinPerColumn) return std::nullopt;
    std::sort(column.begin(), column.end(), [](const Crossing& a, const Crossing& b) { return a.place < b.place; });
    int wrong = 0;
    int ons = 0;
    for (const Crossing& c : column) {
      if (c.on)
        ++ons;
      else
        ++wrong;
    }
    if (ons == 0 || ons == static_cast<int>(column.size())) return std::nullopt;
    // wrong = offs below the split + ons above it, starting with the split above everything.
    int best = wrong;
    std::size_t best_end = column.size();
    for (std::size_t end = column.size(); end-- > 0;) {
      wrong += column[end].on ? 1 : -1;
      if (wrong < best) {
        best = wrong;
        best_end = end;
      }
    }
    if (best_end == 0 || best_end == column.size() || best > static_cast<int>(column.size()) / 4) return std::nullopt;
    return 0.5 * (column[best_end - 1].place + column[best_end].place);
  }

  std::optional<Estimate> across_columns(std::vector<std::vector<Crossing>>& columns, double sign) const {
    std::vector<double> places;
    for (std::vector<Crossing>& column : columns)
      if (const std::optional<double> place = best_split(column)) places.push_back(sign * *place);
    if (places.size() < 3) return std::nullopt;
    return robust_mean(places, 3e-4);
  }

  // The line of sight leaves the front where half the spot does: there the range is half way to what lies behind.
  void measure_nosing() {
    result_.nosing_u = front_u_;
    if (!sensor_) {
      result_.nosing = top_of_front();
      return;
    }
    const auto count = static_cast<std::size_t>(std::max(1.0, side_.length() / kColumn_m));
    std::vector<std::vector<Crossing>> columns(count);
    for (const StairPoint& p : points_) {
      if (p.u < front_u_ - options_.search_m) continue;
      const StairPoint q = at_front(p);
      if (std::abs(q.z - top_z_) > kEdgeReach_m) continue;
      const double column = (q.v - side_.low) / side_.length() * static_cast<double>(count);
      if (column < 0.0 || column >= static_cast<double>(count)) continue;
      columns[static_cast<std::size_t>(column)].push_back({q.z, p.u < front_u_ + 0.5 * model_.depth_m});
    }
    result_.nosing = across_columns(columns, 1.0);
  }

  // Without a line of sight the highest points of the front have to do.
  std::optional<Estimate> top_of_front() const {
    const auto count = static_cast<std::size_t>(std::max(1.0, side_.length() / kColumn_m));
    std::vector<double> tops(count, -1e9);
    for (const StairPoint& p : points_) {
      const double column = (p.v - side_.low) / side_.length() * static_cast<double>(count);
      if (column < 0.0 || column >= static_cast<double>(count) || std::abs(p.u - result_.front->value) > reach_ ||
          std::abs(p.z - top_z_) > options_.search_m)
        continue;
      double& top = tops[static_cast<std::size_t>(column)];
      top = std::max(top, p.z);
    }
    std::erase_if(tops, [](double top) { return top < -1e8; });
    if (tops.size() < 3) return std::nullopt;
    return robust_mean(tops, 3e-3);
  }

  // Like the nosing, but what stands in the way of the front (a post, a bystander) says nothing about its end.
  std::optional<Estimate> measure_end(double end) const {
    const double outward = end > side_.middle() ? 1.0 : -1.0;
    const double inside = std::min(kEndReach_m, 0.5 * side_.length());
    const double low = std::max(visible_bottom(), top_z_ - 0.10);
    const auto count = static_cast<std::size_t>(std::max(1.0, (top_z_ - low) / 0.02));
    std::vector<std::vector<Crossing>> rows(count);
    std::vector<std::vector<double>> hidden(count);
    for (const StairPoint& p : points_) {
      const StairPoint q = at_front(p);
      const double beyond_end = outward * (q.v - end);
      if (beyond_end < -inside || beyond_end > kEndReach_m) continue;
      const double row = (q.z - low) / (top_z_ - low) * static_cast<double>(count);
      if (row < 0.0 || row >= static_cast<double>(count)) continue;
      const auto index = static_cast<std::size_t>(row);
      const double depth = p.u - front_u_;
      if (depth < -kFrontReach_m) {
        hidden[index].push_back(outward * q.v);
      } else {
        rows[index].push_back({outward * q.v, depth < kFrontReach_m});
      }
    }
    for (std::size_t i = 0; i < count; ++i) {
      // A wall at the end of the front hides nothing: it is where the front ends.
      double outermost = outward * end - kEndReach_m;
      for (const Crossing& c : rows[i])
        if (c.on) outermost = std::max(outermost, c.place);
      for (const double place : hidden[i])
        if (place > outermost) rows[i].push_back({place, false});
    }
    return across_columns(rows, outward);
  }

  const StairModel& model_;
  const Interval& side_;
  const std::vector<StairPoint>& points_;
  const std::optional<StairPoint>& sensor_;
  const StepMeasurementOptions& options_;
  double front_u_ = 0.0;
  double top_z_ = 0.0;
  double reach_ = 0.0;
  StepMeasurement result_;
};

}  // namespace

std::string StepMeasurementOptions::problem() const {
  if (!(range_sigma_m > 0.0)) return "range_sigma_m must be greater than 0";
  if (!(spot_rad >= 0.0)) return "spot must not be negative";
  if (!(search_m > 0.0)) return "search_m must be greater than 0";
  if (min_points < 3) return "min_points must be at least 3";
  return {};
}

StairCorridor::StairCorridor(const scan::PointCloud& cloud, const StairModel& model, const Interval& side) {
  constexpr double kMargin_m = 0.5;
  const StairAxes axes(model);
  const StairPoint foot = axes(model.nosing);
  const double slope = model.height_m / model.depth_m;
  if (cloud.sensor_origin) sensor_ = cloud.sensor_origin->cast<double>();
  const auto inside = [&](const StairPoint& p) {
    const double over_slope = p.z - foot.z - (p.u - foot.u) * slope;
    return p.v > side.low - kMargin_m && p.v < side.high + kMargin_m &&
           std::abs(over_slope) < model.height_m + kMargin_m;
  };
  for (const Eigen::Vector3f& point : cloud.points) {
    const Eigen::Vector3d p = point.cast<double>();
    const StairPoint q = axes(p);
    if (!(std::abs(q.u - foot.u) < kFarthestBehind_m)) continue;
    if (inside(q)) {
      points_.push_back(p);
      continue;
    }
    if (!sensor_) continue;
    // Also what is seen past an edge: points whose line of sight has come through the stairway's neighbourhood.
    const StairPoint from = axes(*sensor_);
    const double rise = (q.z - from.z) - (q.u - from.u) * slope;
    const double start = from.z - foot.z - (from.u - foot.u) * slope;
    if (std::abs(rise) < 1e-6) continue;
    const double share = -start / rise;
    if (share <= 0.0 || share >= 1.0) continue;
    if (inside({from.u + share * (q.u - from.u), from.v + share * (q.v - from.v), from.z + share * (q.z - from.z)}))
      points_.push_back(p);
  }
}

std::vector<StepMeasurement> StairCorridor::measure(const StairModel& model, const Interval& side, int first, int last,
                                                    const StepMeasurementOptions& options) const {
  const StairAxes axes(model);
  std::vector<StairPoint> points;
  points.reserve(points_.size());
  for (const Eigen::Vector3d& p : points_) points.push_back(axes(p));
  std::optional<StairPoint> sensor;
  if (sensor_) sensor = axes(*sensor_);

  std::vector<StepMeasurement> steps;
  for (int number = first; number <= last; ++number)
    steps.push_back(StepSurvey(model, side, number, points, sensor, options).measure());
  return steps;
}

}  // namespace stairway::detect
