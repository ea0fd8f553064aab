// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "tools/sim/depth_camera.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "tools/sim/bvh.hpp"
#include "tools/sim/random.hpp"

namespace stairway::sim {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3f;

constexpr double kUsualWidth_px = 640.0;
constexpr float kFarthest_m = 100.0F;
constexpr float kShadowMargin_m = 0.005F;  // a point does not shade itself

std::vector<Vector3f> surface_normals(const Mesh& mesh) {
  std::vector<Vector3f> normals(mesh.surface_count(), Vector3f::UnitZ());
  for (const Triangle& triangle : mesh.triangles()) normals[triangle.surface] = triangle.normal().cast<float>();
  return normals;
}

class Frame {
 public:
  Frame(const Scene& scene, const CameraPose& pose, const DepthCameraOptions& options)
      : bvh_{scene.mesh},
        normals_{surface_normals(scene.mesh)},
        T_scene_camera_{pose.T_scene_camera().cast<float>()},
        projector_{T_scene_camera_ * Vector3f{static_cast<float>(options.baseline_m), 0.0F, 0.0F}},
        options_{options} {}

  float depth(int column, int row, Random& random) const {
    const double jitter = options_.edge_noise_px * options_.intrinsics.width_px / kUsualWidth_px;
    const Vector3d ray = options_.intrinsics.ray(column, row);
    const Vector3d other = options_.intrinsics.ray(column + jitter * random.normal(), row + jitter * random.normal());
    const double noise = random.normal();
    Seen seen = look(ray);
    // Only what lies beside an edge may be seen instead: on one surface the noise of a depth is axial_noise_m() alone.
    if (const Seen beside = look(other); beside.surface != seen.surface) seen = beside;
    if (seen.surface == kNoSurface || seen.incidence_rad > options_.max_incidence_rad || !is_lit(seen.point)) return 0;
    return measured(seen, noise);
  }

 private:
  struct Seen {
    std::uint32_t surface = kNoSurface;
    double depth_m = 0.0;
    double incidence_rad = 0.0;
    Vector3f point = Vector3f::Zero();
  };

  Seen look(const Vector3d& ray) const {
    const double length = ray.norm();
    const Vector3f direction = T_scene_camera_.linear() * (ray / length).cast<float>();
    const Hit hit = bvh_.cast(T_scene_camera_.translation(), direction, kFarthest_m);
    if (hit.surface == kNoSurface) return {};
    const double cosine = std::abs(static_cast<double>(direction.dot(normals_[hit.surface])));
    return {.surface = hit.surface,
            .depth_m = hit.range_m / length,
            .incidence_rad = std::acos(std::min(1.0, cosine)),
            .point = T_scene_camera_.translation() + hit.range_m * direction};
  }

  bool is_lit(const Vector3f& point) const {
    if (options_.baseline_m == 0) return true;
    const float distance = (point - projector_).norm();
    return bvh_.cast(projector_, (point - projector_) / distance, distance - kShadowMargin_m).surface == kNoSurface;
  }

  float measured(const Seen& seen, double noise) const {
    double depth = seen.depth_m + options_.noise_scale * noise * axial_noise_m(seen.depth_m, seen.incidence_rad);
    if (options_.inverse_depth_step > 0 && depth > 0) {
      depth = 1.0 / (options_.inverse_depth_step * std::round(1.0 / (depth * options_.inverse_depth_step)));
    }
    return depth >= options_.min_depth_m && depth <= options_.max_depth_m ? static_cast<float>(depth) : 0.0F;
  }

  Bvh bvh_;
  std::vector<Vector3f> normals_;  // by surface
  Eigen::Isometry3f T_scene_camera_;
  Vector3f projector_;
  const DepthCameraOptions& options_;
};

}  // namespace

Vector3d CameraIntrinsics::ray(double column_px, double row_px) const {
  return {(column_px - 0.5 * (width_px - 1)) / focal_px, (row_px - 0.5 * (height_px - 1)) / focal_px, 1.0};
}

std::optional<Eigen::Vector2d> CameraIntrinsics::pixel(const Vector3d& p_camera) const {
  if (!(p_camera.z() > 0)) return std::nullopt;
  const Eigen::Vector2d place =
      focal_px / p_camera.z() * p_camera.head<2>() + 0.5 * Eigen::Vector2d{width_px - 1, height_px - 1};
  if (!((place.array() >= -0.5).all() && place.x() < width_px - 0.5 && place.y() < height_px - 0.5))
    return std::nullopt;
  return place;
}

std::string CameraIntrinsics::problem() const {
  if (width_px < 1 || height_px < 1 || width_px > 10000 || height_px > 10000) return "camera: image size is unusable";
  if (!(focal_px >= 1.0 && focal_px <= 1e5)) return "camera: focal length must lie between 1 and 100000 px";
  return {};
}

std::string DepthCameraOptions::problem() const {
  if (auto text = intrinsics.problem(); !text.empty()) return text;
  if (!(min_depth_m > 0.0 && max_depth_m > min_depth_m && max_depth_m < kFarthest_m)) {
    return "camera: depths must satisfy 0 < min_depth_m < max_depth_m < 100";
  }
  for (const double number : {noise_scale, inverse_depth_step, edge_noise_px, baseline_m}) {
    if (!(number >= 0.0 && number <= 100.0)) return "camera: noise and baseline must lie between 0 and 100";
  }
  if (!(max_incidence_rad > 0.0 && max_incidence_rad < std::numbers::pi / 2)) {
    return "camera: max_incidence_rad must lie between 0 and pi/2";
  }
  return {};
}

double axial_noise_m(double depth_m, double incidence_rad) {
  const double slant = incidence_rad / (std::numbers::pi / 2 - incidence_rad);
  return 0.0012 + 0.0019 * (depth_m - 0.4) * (depth_m - 0.4) + 0.0001 / std::sqrt(depth_m) * slant * slant;
}

Eigen::Isometry3d CameraPose::T_scene_camera() const {
  Eigen::Matrix3d R_body_camera;  // body: x along the optical axis, y left, z up
  R_body_camera << 0, 0, 1, -1, 0, 0, 0, -1, 0;
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.translate(position);
  T.rotate(Eigen::AngleAxisd{yaw_rad, Vector3d::UnitZ()} * Eigen::AngleAxisd{pitch_down_rad, Vector3d::UnitY()} *
           Eigen::AngleAxisd{roll_rad, Vector3d::UnitX()});
  T.rotate(R_body_camera);
  return T;
}

DepthImage simulate_depth_image(const Scene& scene, const CameraPose& pose, const DepthCameraOptions& options,
                                std::uint64_t seed) {
  if (const std::string problem = options.problem(); !problem.empty()) throw std::invalid_argument{problem};
  DepthImage image{options.intrinsics.width_px, options.intrinsics.height_px, {}};
  image.depth_m.reserve(static_cast<std::size_t>(image.width_px) * static_cast<std::size_t>(image.height_px));
  const Frame frame{scene, pose, options};
  Random random{seed};
  for (int row = 0; row < image.height_px; ++row) {
    for (int column = 0; column < image.width_px; ++column) image.depth_m.push_back(frame.depth(column, row, random));
  }
  return image;
}

scan::PointCloud to_cloud(const DepthImage& image, const CameraIntrinsics& intrinsics, const CameraPose& pose) {
  const Eigen::Isometry3d T = pose.T_scene_camera();
  scan::PointCloud cloud;
  cloud.sensor_origin = pose.position.cast<float>();
  cloud.points.reserve(image.depth_m.size());
  std::size_t pixel = 0;
  for (int row = 0; row < image.height_px; ++row) {
    for (int column = 0; column < image.width_px; ++column) {
      const double depth = image.depth_m[pixel++];
      if (depth > 0) cloud.points.emplace_back((T * (depth * intrinsics.ray(column, row))).cast<float>());
    }
  }
  return cloud;
}

}  // namespace stairway::sim
