// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <numbers>
#include <string>

#include "detector/extents.hpp"

namespace stairway::detect {

/// Where one step of a modelled stairway lies.
struct StepFrame {
  Eigen::Vector3d nosing = Eigen::Vector3d::Zero();    ///< a point of its top front edge, in the middle of the width
  Eigen::Vector3d descent = Eigen::Vector3d::UnitX();  ///< s: horizontal unit direction in which one walks down
  Eigen::Vector3d left() const { return descent.cross(Eigen::Vector3d::UnitZ()); }  ///< seen while ascending
};

/// The paper's stair model: step height h, depth d, orientation s and the top front P of step 0 (section "Stairway
/// Graph"). Step numbers grow upwards and may be negative.
struct StairModel {
  double height_m = 0.0;                               ///< h
  double depth_m = 0.0;                                ///< d
  Eigen::Vector3d descent = Eigen::Vector3d::UnitX();  ///< s at step 0: horizontal, unit, facing the descent
  Eigen::Vector3d nosing = Eigen::Vector3d::Zero();    ///< P_stair [m]
  double overhang_m = 0.0;                             ///< how far a nosing stands out before the riser below it
  double tread_thickness_m = 0.0;                      ///< from a tread to its underside; 0 when none was seen

  /// Eq 6 with the height of eq 9: P_est,j = P - j d s + j h z (the paper prints +j d s, but s faces the descent).
  StepFrame step(int number) const;
};

/// The dimensions a stairway may have.
struct StepLimits {
  double min_height_m = 0.11;  ///< DIN 18065 and the paper's margin of 3 cm
  double max_height_m = 0.24;
  double min_depth_m = 0.18;
  double max_depth_m = 0.40;
  double min_slope_rad = std::numbers::pi / 12;      ///< 15 deg: DIN 18065 and the paper's margin of 5 deg
  double max_slope_rad = std::numbers::pi * 5 / 18;  ///< 50 deg

  std::string problem() const;
  bool allow(double height_m, double depth_m) const;
};

}  // namespace stairway::detect
