// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "scan_assembly/frames.hpp"

#include <cmath>
#include <numbers>
#include <utility>

namespace stairway::scan {
namespace {

using Eigen::AngleAxisd;
using Eigen::Vector3d;

// Written so that NaN is outside.
bool is_within(double value, double limit) { return std::abs(value) <= limit; }

}  // namespace

std::string MountOptions::problem() const {
  constexpr double kPi = std::numbers::pi;
  if (!(std::abs(scan_plane_pitch_rad) < kPi / 2)) return "scan_plane_pitch must lie between -90 and 90 degrees";
  if (!is_within(scan_plane_roll_rad, kPi)) return "scan_plane_roll must lie between -180 and 180 degrees";
  if (!is_within(scan_plane_yaw_rad, kPi)) return "scan_plane_yaw must lie between -180 and 180 degrees";
  for (const auto& [name, value] : {std::pair{"lever_arm_x", lever_arm_x_m}, std::pair{"lever_arm_y", lever_arm_y_m},
                                    std::pair{"lever_arm_z", lever_arm_z_m}}) {
    if (!is_within(value, 1.0)) return std::string(name) + " must lie within 1 m of the disk";
  }
  for (const auto& [name, value] :
       {std::pair{"disk_x", disk_x_m}, std::pair{"disk_y", disk_y_m}, std::pair{"disk_z", disk_z_m}}) {
    if (!is_within(value, 10.0)) return std::string(name) + " must lie within 10 m of the base";
  }
  return {};
}

Eigen::Isometry3d Calibration::T_base_lidar(double phi_rad) const {
  return T_base_disk * AngleAxisd(phi_rad, Vector3d::UnitZ()) * T_disk_lidar;
}

Vector3d Calibration::mean_sensor_origin() const {
  return T_base_disk * Vector3d(0.0, 0.0, T_disk_lidar.translation().z());
}

Calibration make_calibration(const MountOptions& options) {
  Calibration calibration;
  calibration.T_base_disk.translation() = Vector3d(options.disk_x_m, options.disk_y_m, options.disk_z_m);
  calibration.T_disk_lidar.translation() =
      Vector3d(options.lever_arm_x_m, options.lever_arm_y_m, options.lever_arm_z_m);
  // A right-handed turn about y lowers x, hence the minus.
  calibration.T_disk_lidar.linear() = (AngleAxisd(options.scan_plane_yaw_rad, Vector3d::UnitZ()) *
                                       AngleAxisd(-options.scan_plane_pitch_rad, Vector3d::UnitY()) *
                                       AngleAxisd(options.scan_plane_roll_rad, Vector3d::UnitX()))
                                          .toRotationMatrix();
  return calibration;
}

}  // namespace stairway::scan
