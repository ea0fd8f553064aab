// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <string>

namespace stairway::scan {

/// How the scanner sits on the disk and the disk on the robot.
///
/// Frames, all right-handed with z up: `base` on the levelled floor under the disk axis, x forward, y left; `disk`
/// turns with the disk, z = turning axis, angle 0 at the encoder index; `lidar` has x along the front beam and beams
/// counted counter-clockwise about z. The default sees elevations from -37.8 to +60 degrees and every direction twice
/// in a turn.
struct MountOptions {
  double scan_plane_pitch_rad = 1.0471975511965976;  ///< front beam above the disk plane; -60 deg = mounted inverted,
                                                     ///< to look down stairs [rad], in (-pi/2, pi/2)
  double scan_plane_roll_rad = 0.0;                  ///< turn about the front beam, left side up [rad], in [-pi, pi]
  double scan_plane_yaw_rad = 0.0;                   ///< front beam left of the encoder index [rad], in [-pi, pi]
  double lever_arm_x_m = 0.0;                        ///< scanner origin in `disk` [m], within 1 m
  double lever_arm_y_m = 0.0;                        ///< likewise
  double lever_arm_z_m = 0.0;                        ///< likewise
  double disk_x_m = 0.0;                             ///< disk origin in `base` [m], within 10 m
  double disk_y_m = 0.0;                             ///< likewise
  double disk_z_m = 0.5;  ///< likewise; with no lever arm the scanner's height above the floor

  /// First problem found, worded for the person editing the file; empty when usable.
  std::string problem() const;
};

/// The two constant transforms around the disk's turning:
/// p_base = T_base_disk * Rz(phi) * T_disk_lidar * p_lidar.
struct Calibration {
  Eigen::Isometry3d T_base_disk = Eigen::Isometry3d::Identity();
  Eigen::Isometry3d T_disk_lidar = Eigen::Isometry3d::Identity();

  /// Transform at the disk angle `phi_rad` (counter-clockwise from above).
  Eigen::Isometry3d T_base_lidar(double phi_rad) const;

  /// Mean place of the scanner over a whole turn, in `base` [m]: the foot of its lever arm on the turning axis.
  Eigen::Vector3d mean_sensor_origin() const;
};

/// The transforms of a mount: yaw, then pitch, then roll, each about the axis already turned.
Calibration make_calibration(const MountOptions& options);

}  // namespace stairway::scan
