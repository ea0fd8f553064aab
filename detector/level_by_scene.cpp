// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "detector/level_by_scene.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace stairway::detect {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;
// What planes of buildings are off by, beyond what their scatter says.
constexpr double kBuilt_rad = 0.05 * kDegree;
constexpr double kFloor_rad = 0.2 * kDegree;
// A floor that others find level to within this was not laid to drain; being the largest plane, it then tells best.
constexpr double kLevelFloor_rad = 0.1 * kDegree;
constexpr double kTrustedFloor_rad = 0.01 * kDegree;
constexpr double kFewestPoints = 100;
constexpr double kLargeFloor = 500;  // points

/// What one plane says about up = (t.x, t.y, 1): along . t = value.
struct Evidence {
  Eigen::Vector2d along = Eigen::Vector2d::UnitX();
  double value = 0.0;
  double sigma_rad = 0.0;
};

struct Tilt {
  Eigen::Vector2d t = Eigen::Vector2d::Zero();
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Identity();

  Eigen::Vector3d up() const { return Eigen::Vector3d(t.x(), t.y(), 1.0).normalized(); }
};

bool is_level(const PlaneRegion& region, double max_tilt_rad) {
  return std::abs(region.axes.normal().z()) > std::cos(max_tilt_rad);
}

bool is_upright(const PlaneRegion& region, double max_tilt_rad) {
  return std::abs(region.axes.normal().z()) < std::sin(max_tilt_rad);
}

// How well a plane's normal is known about one of its own axes, whose variance of places is given.
double normal_sigma(const PlaneRegion& region, double variance_m2) {
  const double n = static_cast<double>(region.points.size());
  return std::sqrt(std::max(region.axes.variances[2], 1e-12) / (n * std::max(variance_m2, 1e-9)));
}

void add_level_plane(const PlaneRegion& region, double built_rad, std::vector<Evidence>& evidence) {
  const Eigen::Vector3d n = region.axes.normal() / region.axes.normal().z();
  for (const int axis : {0, 1}) {
    const Eigen::Vector2d along = region.axes.axes.col(axis).head<2>().normalized();
    evidence.push_back({.along = along,
                        .value = along.dot(n.head<2>()),
                        .sigma_rad = std::hypot(normal_sigma(region, region.axes.variances[axis]), built_rad)});
  }
}

void add_upright_plane(const PlaneRegion& region, std::vector<Evidence>& evidence) {
  const Eigen::Vector3d n = region.axes.normal();
  const double upright = n.head<2>().norm();
  double variance_z = 0.0;
  for (const int axis : {0, 1}) variance_z += region.axes.variances[axis] * std::pow(region.axes.axes.col(axis).z(), 2);
  evidence.push_back({
      .along = n.head<2>() / upright,
      .value = -n.z() / upright,
      .sigma_rad = std::hypot(normal_sigma(region, variance_z), kBuilt_rad),
  });
}

// The tilt that most of the evidence agrees on: what disagrees counts for less and less.
Tilt consensus(const std::vector<Evidence>& evidence, double widest_rad) {
  constexpr double kNarrowing = 0.7;
  constexpr double kAgree = 2.5;  // sigmas
  Tilt tilt;
  for (double reach = widest_rad; reach > 0.02 * kDegree; reach *= kNarrowing) {
    Eigen::Matrix2d information = 1e-3 * Eigen::Matrix2d::Identity();
    Eigen::Vector2d pull = Eigen::Vector2d::Zero();
    for (const Evidence& e : evidence) {
      const double scale = std::max(reach, kAgree * e.sigma_rad);
      const double off = (e.value - e.along.dot(tilt.t)) / scale;
      const double weight = 1.0 / std::pow(e.sigma_rad * (1.0 + off * off), 2);
      information += weight * e.along * e.along.transpose();
      pull += weight * e.value * e.along;
    }
    tilt.covariance = information.inverse();
    tilt.t = tilt.covariance * pull;
  }
  return tilt;
}

bool agrees(const Evidence& e, const Tilt& tilt) { return std::abs(e.value - e.along.dot(tilt.t)) < 3.0 * e.sigma_rad; }

// The largest level plane that passes under the robot, which stands on it.
std::optional<std::size_t> find_floor_region(const std::vector<PlaneRegion>& regions, double max_tilt_rad) {
  constexpr double kUnderfoot_m = 0.15;
  std::optional<std::size_t> floor;
  for (std::size_t i = 0; i < regions.size(); ++i) {
    const PrincipalAxes& axes = regions[i].axes;
    if (!is_level(regions[i], max_tilt_rad) || static_cast<double>(regions[i].points.size()) < kLargeFloor) continue;
    if (std::abs(axes.centroid.dot(axes.normal()) / axes.normal().z()) > kUnderfoot_m) continue;
    if (!floor || regions[i].points.size() > regions[*floor].points.size()) floor = i;
  }
  return floor;
}

std::vector<Evidence> collect(const std::vector<PlaneRegion>& regions, std::optional<std::size_t> floor,
                              double floor_rad, double max_tilt_rad) {
  std::vector<Evidence> evidence;
  for (std::size_t i = 0; i < regions.size(); ++i) {
    if (static_cast<double>(regions[i].points.size()) < kFewestPoints) continue;
    if (is_level(regions[i], max_tilt_rad)) {
      add_level_plane(regions[i], floor == i ? floor_rad : kBuilt_rad, evidence);
    } else if (is_upright(regions[i], max_tilt_rad)) {
      add_upright_plane(regions[i], evidence);
    }
  }
  return evidence;
}

double slope_of(const PlaneRegion& region, const Tilt& tilt) {
  return std::acos(std::min(1.0, std::abs(region.axes.normal().dot(tilt.up()))));
}

void describe_floor(const PlaneRegion& region, const Tilt& tilt, SceneLevel& level) {
  Eigen::Vector3d normal = level.T_level_cloud.linear() * region.axes.normal();
  const Eigen::Vector3d place = level.T_level_cloud * region.axes.centroid;
  normal /= normal.z();
  level.floor = Eigen::Vector3d(-normal.x(), -normal.y(), place.z() + normal.head<2>().dot(place.head<2>()));
  level.floor_slope_rad = slope_of(region, tilt);
}

}  // namespace

std::string SceneLevelOptions::problem() const {
  if (!(max_tilt_rad > 0.0 && max_tilt_rad < std::numbers::pi / 8))
    return "max_tilt must lie between 0 and 22.5 degrees";
  if (!(max_sigma_rad > 0.0)) return "max_sigma must be greater than 0";
  return {};
}

double SceneLevel::floor_at(const Eigen::Vector3d& place) const {
  return floor ? floor->x() * place.x() + floor->y() * place.y() + floor->z() : 0.0;
}

std::optional<SceneLevel> level_by_scene(const std::vector<PlaneRegion>& regions, const SceneLevelOptions& options) {
  const std::optional<std::size_t> floor = find_floor_region(regions, options.max_tilt_rad);
  std::vector<Evidence> evidence = collect(regions, floor, kFloor_rad, options.max_tilt_rad);
  Tilt tilt = consensus(evidence, options.max_tilt_rad);
  if (floor && slope_of(regions[*floor], tilt) < kLevelFloor_rad) {
    evidence = collect(regions, floor, kTrustedFloor_rad, options.max_tilt_rad);
    tilt = consensus(evidence, options.max_tilt_rad);
  }
  const Eigen::Vector3d up = tilt.up();
  SceneLevel level;
  level.sigma_rad = std::sqrt(tilt.covariance.eigenvalues().real().maxCoeff());
  if (!(level.sigma_rad < options.max_sigma_rad) || std::acos(std::min(1.0, up.z())) > options.max_tilt_rad)
    return std::nullopt;
  level.planes = static_cast<int>(
      std::count_if(evidence.begin(), evidence.end(), [&](const Evidence& e) { return agrees(e, tilt); }));
  level.T_level_cloud = Eigen::Isometry3d(Eigen::Quaterniond::FromTwoVectors(up, Eigen::Vector3d::UnitZ()));
  level.roll_rad = std::atan2(up.y(), up.z());
  level.pitch_rad = -std::asin(std::clamp(up.x(), -1.0, 1.0));
  if (floor) describe_floor(regions[*floor], tilt, level);
  return level;
}

void transform(std::vector<PlaneRegion>& regions, const Eigen::Isometry3d& T) {
  for (PlaneRegion& region : regions) {
    region.axes.centroid = T * region.axes.centroid;
    region.axes.axes = T.linear() * region.axes.axes;
  }
}

}  // namespace stairway::detect
