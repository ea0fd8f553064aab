// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "scan_assembly/point_cloud.hpp"
#include "tools/sim/scene.hpp"

namespace stairway::sim {

/// A pinhole camera without distortion: x right, y down, z along the optical axis.
struct CameraIntrinsics {
  int width_px = 640;
  int height_px = 480;
  double focal_px = 580.0;  ///< 58 by 45 degrees at 640 by 480

  /// The ray through the middle of a pixel, at depth 1.
  Eigen::Vector3d ray(double column_px, double row_px) const;
  /// Column and row where a point in the camera's frame appears; nothing when it is behind the camera or beside the
  /// image.
  std::optional<Eigen::Vector2d> pixel(const Eigen::Vector3d& p_camera) const;
  std::string problem() const;
};

/// A structured-light camera as the Kinect v1 and how it differs from a perfect one.
struct DepthCameraOptions {
  CameraIntrinsics intrinsics;
  double min_depth_m = 0.5;  ///< nearer and farther pixels are missing
  double max_depth_m = 4.5;
  double noise_scale = 1.0;             ///< of axial_noise_m(); 0 is a perfect camera
  double inverse_depth_step = 2.87e-3;  ///< 1/z comes in multiples of it: disparities of 1/8 pixel over a baseline of
                                        ///< 75 mm (Khoshelham and Elberink, Sensors 2012) [1/m]; 0 is exact
  double edge_noise_px = 0.8;           ///< standard deviation of the place of edges, at 640 columns [px]
  double baseline_m = 0.075;            ///< what the projector, right of the camera, does not light has no depth [m]
  double max_incidence_rad = 1.3;       ///< between ray and normal; surfaces seen flatter have no depth [rad]

  /// First problem found; empty when usable.
  std::string problem() const;
};

/// Standard deviation of a depth: 1.2 mm + 1.9 mm ((z - 0.4 m)/m)^2, and more on slanted surfaces (Nguyen, Izadi,
/// Lovell, "Modeling Kinect Sensor Noise for Improved 3D Reconstruction and Tracking", 3DIMPVT 2012).
///
/// @param depth_m        along the optical axis, above 0 [m].
/// @param incidence_rad  between the ray and the surface's normal, in [0, pi/2) [rad].
double axial_noise_m(double depth_m, double incidence_rad);

/// Where the camera is and where it looks; its owner stands at x = y = 0 of the scene.
struct CameraPose {
  Eigen::Vector3d position{0.0, 0.0, 1.7};  ///< scene frame [m]
  double yaw_rad = 0.0;                     ///< of the optical axis, counter-clockwise from x
  double pitch_down_rad = 0.5;              ///< of the optical axis below the horizon
  double roll_rad = 0.0;                    ///< about the optical axis, right side down

  Eigen::Isometry3d T_scene_camera() const;
};

/// One frame, row by row.
struct DepthImage {
  int width_px = 0;
  int height_px = 0;
  std::vector<float> depth_m;  ///< along the optical axis; 0 where there is none
};

/// Takes one frame. Noise is independent from pixel to pixel, which a real camera's, matched over blocks, is not; there
/// is no dark, shiny or sunlit surface. The result depends on the arguments alone. Throws std::invalid_argument for
/// options with a problem. Cost: up to three rays per pixel, about 1 s of one core at 640 by 480.
DepthImage simulate_depth_image(const Scene& scene, const CameraPose& pose, const DepthCameraOptions& options,
                                std::uint64_t seed);

/// Points of the pixels that have a depth, in order, as a camera at `pose` would place them. sensor_origin is the
/// camera. A pose that is not the true one (a gravity sensor that errs) tilts the cloud as it would a real one.
scan::PointCloud to_cloud(const DepthImage& image, const CameraIntrinsics& intrinsics, const CameraPose& pose);

}  // namespace stairway::sim
