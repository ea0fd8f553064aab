// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <numbers>
#include <string>

#include "detector/extents.hpp"

namespace stairway::detect {

/// A point as one step sees it [m].
struct StepPoint {
  double u = 0.0;  ///< along the ascent, from the nosing
  double v = 0.0;  ///< to the left, from the model's middle line
  double z = 0.0;  ///< above the nosing
};

/// Where one step of a modelled stairway lies.
struct StepFrame {
  Eigen::Vector3d nosing = Eigen::Vector3d::Zero();    ///< the point of its top front edge on the model's middle line
  Eigen::Vector3d descent = Eigen::Vector3d::UnitX();  ///< s: horizontal unit direction in which one walks down
  Eigen::Vector3d left() const { return descent.cross(Eigen::Vector3d::UnitZ()); }  ///< seen while ascending
  StepPoint to_step(const Eigen::Vector3d& p) const;
  Eigen::Vector3d from_step(const StepPoint& p) const;
};

/// The paper's stair model: step height h, depth d, orientation s, the top front P of step 0 and, of a spiral, the turn
/// delta phi from step to step (section "Stairway Graph"). Step numbers grow upwards and may be negative.
///
/// The nosings of a spiral point at its axis, which lies d / (2 sin(delta phi / 2)) to the left of P; so d is the chord
/// between neighbouring nosings on the circle through P, the model's middle line.
struct StairModel {
  double height_m = 0.0;                               ///< h
  double depth_m = 0.0;                                ///< d
  Eigen::Vector3d descent = Eigen::Vector3d::UnitX();  ///< s at step 0: horizontal, unit, facing the descent
  Eigen::Vector3d nosing = Eigen::Vector3d::Zero();    ///< P_stair [m]
  double turn_rad = 0.0;           ///< delta phi; positive when the ascent turns left, 0 when straight
  double overhang_m = 0.0;         ///< how far a nosing stands out before the riser below it
  double tread_thickness_m = 0.0;  ///< from a tread to its underside; 0 when none was seen

  /// Eq 6 with the height of eq 9: P_est,j = P - j d s + j h z (the paper prints +j d s, but s faces the descent).
  /// Between steps when `number` is no whole one: there half way along the tread, say.
  StepFrame step(double number) const;
  bool is_spiral() const { return turn_rad != 0.0; }
  /// Signed distance from P to the axis along left(). @pre is_spiral()
  double radius_m() const;
  /// The same stairway with P moved by `left_m` along its nosing; the depth of a spiral follows.
  StairModel moved_aside(double left_m) const;
};

/// The dimensions a stairway may have.
struct StepLimits {
  double min_height_m = 0.11;  ///< DIN 18065 and the paper's margin of 3 cm
  double max_height_m = 0.24;
  double min_depth_m = 0.18;
  double max_depth_m = 0.40;
  double min_slope_rad = std::numbers::pi / 12;      ///< 15 deg: DIN 18065 and the paper's margin of 5 deg
  double max_slope_rad = std::numbers::pi * 5 / 18;  ///< 50 deg
  double min_turn_rad = std::numbers::pi / 18;       ///< 10 deg: what turns less from step to step is no spiral
  double max_turn_rad = std::numbers::pi * 5 / 18;   ///< 50 deg

  std::string problem() const;
  bool allow(const StairModel& model) const;
};

}  // namespace stairway::detect
