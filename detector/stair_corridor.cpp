// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "detector/stair_corridor.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace stairway::detect {
namespace {

constexpr double kMargin_m = 0.5;
constexpr double kFarthest_m = 30.0;

// Each tells whether the way from one point to another enters the neighbourhood of a stairway.

// A straight flight lies in a slab along its slope, between its sides.
auto through_slab(const StairModel& model, const Interval& sides) {
  const StepFrame frame = model.step(0);
  const double slope = model.height_m / model.depth_m;
  const double half_height = model.height_m + kMargin_m;
  const double low = sides.low - kMargin_m;
  const double high = sides.high + kMargin_m;
  return [=](const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
    const StepPoint a = frame.to_step(from);
    const StepPoint b = frame.to_step(to);
    const double above_a = a.z - a.u * slope;
    const double above_b = b.z - b.u * slope;
    if (std::abs(above_b) < half_height && b.v > low && b.v < high) return true;
    if (above_a * above_b >= 0.0) return false;
    const double v = a.v + (b.v - a.v) * above_a / (above_a - above_b);
    return v > low && v < high;
  };
}

// A spiral lies in a cylinder about its axis.
auto through_cylinder(const StairModel& model, const Interval& sides) {
  const Eigen::Vector2d axis = model.step(0).from_step({.v = model.radius_m()}).head<2>();
  const double radius =
      std::max(std::abs(model.radius_m() - sides.low), std::abs(model.radius_m() - sides.high)) + kMargin_m;
  return [=](const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
    const Eigen::Vector2d way = (to - from).head<2>();
    const double nearest = std::clamp((axis - from.head<2>()).dot(way) / std::max(way.squaredNorm(), 1e-12), 0.0, 1.0);
    return (from.head<2>() + nearest * way - axis).squaredNorm() < radius * radius;
  };
}

}  // namespace

StairCorridor::StairCorridor(const scan::PointCloud& cloud, const StairModel& model, const Interval& sides) {
  if (cloud.sensor_origin) sensor_ = cloud.sensor_origin->cast<double>();
  const auto pick = [&](const auto& enters) {
    for (const Eigen::Vector3f& point : cloud.points) {
      const Eigen::Vector3d p = point.cast<double>();
      const bool near = (p - model.nosing).squaredNorm() < kFarthest_m * kFarthest_m;  // false for what is not finite
      if (near && enters(sensor_.value_or(p), p)) points_.push_back(p);
    }
  };
  if (model.is_spiral()) {
    pick(through_cylinder(model, sides));
    if (sensor_) sort_around_spiral(model);
  } else {
    pick(through_slab(model, sides));
    if (sensor_) fan_.emplace(points_, *sensor_, Eigen::Vector3d::UnitZ(), -model.descent);
  }
}

// Its steps are seen beside each other rather than above each other.
void StairCorridor::sort_around_spiral(const StairModel& model) {
  const Eigen::Vector3d axis = model.step(0).from_step({.v = model.radius_m()});
  Eigen::Vector3d away = *sensor_ - axis;
  away.z() = 0.0;
  if (!(away.norm() > 0.0)) away = Eigen::Vector3d::UnitX();
  away.normalize();
  fan_.emplace(points_, *sensor_, away, away.cross(Eigen::Vector3d::UnitZ()));
}

std::span<const Eigen::Vector3d> StairCorridor::points_at(std::span<const Eigen::Vector3d> corners) const {
  if (!fan_) return points_;
  const auto [first, last] = fan_->within_or_behind(corners);
  return std::span(points_).subspan(first, last - first);
}

}  // namespace stairway::detect
