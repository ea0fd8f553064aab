// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "detector/levelling.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "detector/normals.hpp"
#include "detector/plane.hpp"
#include "detector/voxel_grid.hpp"

namespace stairway::detect {
namespace {

constexpr double kThinning_m = 0.05;
constexpr double kNormalRadius_m = 0.15;
constexpr double kBin_m = 0.02;
// A level counts as a floor when it has this share of the points of the most populated level.
constexpr double kShareOfLargest = 0.3;
constexpr int kRefinements = 6;

// The direction about which the normals of level surfaces cluster, found by narrowing a cone around it.
Eigen::Vector3d dominant_vertical(const std::vector<Eigen::Vector3f>& normals, double max_tilt_rad) {
  Eigen::Vector3d axis = Eigen::Vector3d::UnitZ();
  for (double cone = max_tilt_rad; cone > 0.01; cone *= 0.7) {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (const Eigen::Vector3f& normal : normals) {
      const Eigen::Vector3d n = normal.cast<double>();
      if (std::abs(n.dot(axis)) > std::cos(cone)) sum += n.dot(axis) < 0.0 ? Eigen::Vector3d(-n) : n;
    }
    if (sum.norm() > 0.0) axis = sum.normalized();
  }
  return axis;
}

// The lowest well-populated level along `axis`.
std::optional<double> lowest_level(const std::vector<double>& heights) {
  if (heights.empty()) return std::nullopt;
  const auto [low, high] = std::minmax_element(heights.begin(), heights.end());
  std::vector<int> bins(static_cast<std::size_t>((*high - *low) / kBin_m) + 1, 0);
  for (const double height : heights) ++bins[static_cast<std::size_t>((height - *low) / kBin_m)];
  const int enough = static_cast<int>(kShareOfLargest * *std::max_element(bins.begin(), bins.end()));
  for (std::size_t i = 0; i < bins.size(); ++i) {
    const bool peak = (i == 0 || bins[i - 1] <= bins[i]) && (i + 1 == bins.size() || bins[i + 1] <= bins[i]);
    if (peak && bins[i] >= std::max(enough, 1)) return *low + (static_cast<double>(i) + 0.5) * kBin_m;
  }
  return std::nullopt;
}

}  // namespace

std::string FloorOptions::problem() const {
  if (!(max_tilt_rad > 0.0 && max_tilt_rad < std::numbers::pi / 2)) return "max_tilt must lie between 0 and 90 degrees";
  if (!(max_distance_m > 0.0)) return "max_distance_m must be greater than 0";
  if (!(min_share > 0.0 && min_share < 1.0)) return "min_share must lie between 0 and 1";
  return {};
}

Eigen::Isometry3d upright_from_gravity(const Eigen::Vector3d& gravity) {
  return Eigen::Isometry3d(Eigen::Quaterniond::FromTwoVectors(gravity, -Eigen::Vector3d::UnitZ()));
}

Eigen::Isometry3d upright_from_roll_pitch(double roll_rad, double pitch_rad) {
  return Eigen::Isometry3d(Eigen::AngleAxisd(pitch_rad, Eigen::Vector3d::UnitY()) *
                           Eigen::AngleAxisd(roll_rad, Eigen::Vector3d::UnitX()));
}

std::optional<FloorFit> find_floor(const scan::PointCloud& cloud, const FloorOptions& options) {
  const scan::PointCloud thinned = voxel_centroids(cloud, kThinning_m);
  if (thinned.points.size() < 3) return std::nullopt;
  const SurfaceNormals surface = estimate_normals(thinned, {.radius_m = kNormalRadius_m});
  Eigen::Vector3d up = dominant_vertical(surface.normals, options.max_tilt_rad);

  std::vector<double> heights;
  for (std::size_t i = 0; i < thinned.points.size(); ++i)
    if (std::abs(surface.normals[i].cast<double>().dot(up)) > std::cos(options.max_tilt_rad))
      heights.push_back(thinned.points[i].cast<double>().dot(up));
  const std::optional<double> level = lowest_level(heights);
  if (!level) return std::nullopt;

  double height = *level;
  std::size_t count = 0;
  for (int i = 0; i < kRefinements; ++i) {
    PointMoments moments;
    for (const Eigen::Vector3f& p : thinned.points)
      if (std::abs(p.cast<double>().dot(up) - height) < options.max_distance_m) moments.add(p);
    count = moments.count();
    if (count < 3) return std::nullopt;
    const PrincipalAxes axes = principal_axes(moments);
    up = axes.normal().z() < 0.0 ? Eigen::Vector3d(-axes.normal()) : axes.normal();
    height = axes.centroid.dot(up);
  }
  FloorFit fit;
  fit.share = static_cast<double>(count) / static_cast<double>(thinned.points.size());
  fit.tilt_rad = std::acos(std::min(up.z(), 1.0));
  if (fit.share < options.min_share || fit.tilt_rad > options.max_tilt_rad) return std::nullopt;
  fit.T_level_cloud = Eigen::Isometry3d(Eigen::Quaterniond::FromTwoVectors(up, Eigen::Vector3d::UnitZ()));
  fit.T_level_cloud.pretranslate(Eigen::Vector3d(0.0, 0.0, -height));
  return fit;
}

scan::PointCloud transformed(const scan::PointCloud& cloud, const Eigen::Isometry3d& transform) {
  const Eigen::Isometry3f T = transform.cast<float>();
  scan::PointCloud result;
  result.points.reserve(cloud.points.size());
  for (const Eigen::Vector3f& p : cloud.points) result.points.push_back(T * p);
  if (cloud.sensor_origin) result.sensor_origin = T * *cloud.sensor_origin;
  return result;
}

}  // namespace stairway::detect
