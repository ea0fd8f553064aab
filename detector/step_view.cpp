// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "detector/step_view.hpp"

#include <algorithm>
#include <cmath>

#include "detector/statistics.hpp"
#include "detector/step_reaches.hpp"

namespace stairway::detect {

StepView::StepView(const StairCorridor& corridor, const StairModel& model, const Interval& sides, int number,
                   const StepMeasurementOptions& options)
    : model_(model), sides_(sides), options_(options), frame_(model.step(number)) {
  if (corridor.sensor()) sensor_ = frame_.to_step(*corridor.sensor());
  const StepFrame next = model.step(number + 1);
  next_ = frame_.to_step(next.nosing);
  next_slope_ = next.left().dot(-frame_.descent) / next.left().dot(frame_.left());
  for (const Eigen::Vector3d& point : corridor.points_at(surroundings()))
    if (const StepPoint p = frame_.to_step(point); is_worth_a_look(p)) points_.push_back(p);
}

// The corners of a box that holds all places where is_worth_a_look() looks for points or lines of sight.
std::array<Eigen::Vector3d, 8> StepView::surroundings() const {
  const Interval beside{sides_.low - kEndReach_m, sides_.high + kEndReach_m};
  const Interval along{std::min(-kLandingFar * model_.depth_m, front_u()) - margin_m(),
                       std::max({depth_at(beside.low), depth_at(beside.high), margin_m(), kEndBand_m, front_u()})};
  const Interval up{-model_.height_m - margin_m(), margin_m()};
  std::array<Eigen::Vector3d, 8> corners;
  for (std::size_t i = 0; i < corners.size(); ++i)
    corners[i] = frame_.from_step({(i & 1U) != 0 ? along.low : along.high, (i & 2U) != 0 ? beside.low : beside.high,
                                   (i & 4U) != 0 ? up.low : up.high});
  return corners;
}

bool StepView::is_worth_a_look(const StepPoint& p) const {
  const double margin = margin_m();
  const auto is_beside = [&](double v) { return v > sides_.low - kEndReach_m && v < sides_.high + kEndReach_m; };
  const auto is_near = [&](double v, double z) { return is_beside(v) && z > -model_.height_m - margin && z < margin; };
  const double first_u = std::abs(p.z) < margin ? -kLandingFar * model_.depth_m : front_u() - margin;
  if (is_near(p.v, p.z) && p.u > first_u && p.u < depth_at(p.v)) return true;
  if (!sensor_) return false;
  if (faces_front() && p.u > sensor_->u + kClearance_m) {
    const StepPoint q = at_front(p);
    if (is_near(q.v, q.z)) return true;
  }
  if (sensor_->z > std::max(p.z, 0.0) + kClearance_m) {
    const StepPoint q = at_tread(p);
    return q.u > -margin && q.u < std::max(margin, kEndBand_m) && is_beside(q.v);
  }
  return false;
}

bool StepView::faces_front() const { return !sensor_ || sensor_->u < front_u() - kClearance_m; }

bool StepView::stands_behind_nosing() const {
  return sensor_ && sensor_->u > kClearance_m && sensor_->z > kClearance_m;
}

bool StepView::stands_behind_tread() const {
  return stands_behind_nosing() && sensor_->u > model_.depth_m + kClearance_m;
}

StepPoint StepView::at_upright(const StepPoint& p, double u) const {
  if (!sensor_) return p;
  const double share = (u - sensor_->u) / std::max(p.u - sensor_->u, 1e-3);
  return {u, sensor_->v + (p.v - sensor_->v) * share, sensor_->z + (p.z - sensor_->z) * share};
}

StepPoint StepView::at_tread(const StepPoint& p) const {
  const double share = sensor_->z / std::max(sensor_->z - p.z, 1e-3);
  return {sensor_->u + (p.u - sensor_->u) * share, sensor_->v + (p.v - sensor_->v) * share, 0.0};
}

bool StepView::has_lip() const {
  constexpr double kLeast_m = 0.003;
  return model_.overhang_m > kLeast_m;
}

double StepView::spot_radius_m() const {
  if (!sensor_) return 0.0;
  return 0.5 * options_.spot_rad * std::hypot(front_u() - sensor_->u, sides_.middle() - sensor_->v, sensor_->z);
}

double StepView::visible_bottom_m() const {
  const double below = -model_.height_m;
  if (!sensor_ || sensor_->z >= below) return below;
  const double nosing_u = front_u() - model_.depth_m;
  if (sensor_->u > nosing_u - kClearance_m) return below;
  return std::min(sensor_->z + (below - sensor_->z) * (front_u() - sensor_->u) / (nosing_u - sensor_->u), 0.0);
}

bool StepView::covers_sides(const std::vector<double>& places) const {
  constexpr double kStrip_m = 0.10;
  const auto strips = static_cast<std::size_t>(std::max(1.0, std::floor(sides_.length() / kStrip_m)));
  std::vector<bool> hit(strips, false);
  for (const double v : places) {
    const auto strip = static_cast<std::ptrdiff_t>((v - sides_.low) / sides_.length() * static_cast<double>(strips));
    if (strip >= 0 && strip < static_cast<std::ptrdiff_t>(strips)) hit[static_cast<std::size_t>(strip)] = true;
  }
  return static_cast<double>(std::count(hit.begin(), hit.end(), true)) >=
         options_.min_coverage * static_cast<double>(strips);
}

Estimate robust_mean(const std::vector<double>& values, double floor) {
  const double middle = median(values);
  const double scatter = robust_deviation(values, middle);
  return {middle, std::max(floor, 1.2533 * scatter / std::sqrt(static_cast<double>(values.size())))};
}

double densest_place(const std::vector<double>& sorted, double reach) {
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

}  // namespace stairway::detect
