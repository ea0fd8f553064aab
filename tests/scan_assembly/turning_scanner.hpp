// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <vector>

#include "drivers/types.hpp"
#include "scan_assembly/frames.hpp"

namespace stairway::scan {

/// A scanner on a disk that turns evenly, inside a box room: the obvious way, one transform per beam.
struct TurningScanner {
  Calibration calibration = make_calibration({});
  double speed_rad_s = 1.0;
  double angle_at_zero_rad = 0.0;
  double beam_interval_ns = 25e6 / 1440;
  Eigen::Vector3d room_min = {-4.0, -5.0, 0.0};
  Eigen::Vector3d room_max = {6.0, 3.0, 2.5};

  double angle_rad(drivers::HostStamp stamp_ns) const {
    return angle_at_zero_rad + speed_rad_s * 1e-9 * static_cast<double>(stamp_ns);
  }

  drivers::AngleSample sample(drivers::HostStamp stamp_ns) const { return {stamp_ns, angle_rad(stamp_ns), true}; }

  static drivers::HostStamp scan_begin_ns(std::uint64_t sequence) {
    return static_cast<drivers::HostStamp>(sequence) * 25'000'000;
  }

  drivers::LaserScan scan(std::uint64_t sequence) const {
    drivers::LaserScan scan;
    scan.sequence = sequence;
    scan.first_beam_stamp_ns = scan_begin_ns(sequence);
    scan.beam_interval_ns = beam_interval_ns;
    scan.first_angle_rad = -0.75 * std::numbers::pi;
    scan.angle_increment_rad = 2.0 * std::numbers::pi / 1440;
    for (int k = 0; k <= 1080; ++k) {
      const auto stamp_ns = scan.first_beam_stamp_ns + std::llround(k * beam_interval_ns);
      const double beam_rad = scan.first_angle_rad + k * scan.angle_increment_rad;
      const Eigen::Isometry3d T_base_lidar = calibration.T_base_lidar(angle_rad(stamp_ns));
      scan.ranges_m.push_back(static_cast<float>(
          range_m(T_base_lidar.translation(),
                  T_base_lidar.linear() * Eigen::Vector3d(std::cos(beam_rad), std::sin(beam_rad), 0.0))));
      scan.statuses.push_back(drivers::BeamStatus::Ok);
    }
    return scan;
  }

  /// How far a point is from the nearest wall, floor or ceiling [m].
  double distance_to_room_m(const Eigen::Vector3d& point) const {
    return std::min((point - room_min).cwiseAbs().minCoeff(), (point - room_max).cwiseAbs().minCoeff());
  }

 private:
  double range_m(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction) const {
    double range = std::numeric_limits<double>::infinity();
    for (int axis = 0; axis < 3; ++axis) {
      const double wall = direction[axis] > 0.0 ? room_max[axis] : room_min[axis];
      if (direction[axis] != 0.0) range = std::min(range, (wall - origin[axis]) / direction[axis]);
    }
    return range;
  }
};

}  // namespace stairway::scan
