// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "detector/stairway.hpp"

namespace stairway::tools {

/// Space unrolled along a stairway: x = way along the ascent from the lowest nosing, at the middle of the width; y =
/// to the left of the middle; z = height in `base` [m]. A straight flight is only turned and moved; a spiral becomes a
/// straight flight.
class StairChart {
 public:
  /// @pre at least one nosing.
  explicit StairChart(const detect::Stairway& stairway);

  Eigen::Vector3d to_chart(const Eigen::Vector3d& p_base) const;

  /// The middle of every nosing, lowest first, in the chart.
  const std::vector<Eigen::Vector3d>& nosings() const { return nosings_; }

  double half_width_m() const { return half_width_m_; }

  /// The floor below the lowest nosing.
  double foot_m() const { return foot_m_; }

  enum class Part { None, Tread, Riser };
  /// On which part of a step the point of the chart lies, within `tolerance_m`. Treads begin at their nosing and end at
  /// the next one.
  Part part_at(const Eigen::Vector3d& p_chart, double tolerance_m) const;

 private:
  struct Axis {
    Eigen::Vector2d centre;
    double radius_m;   ///< at the middle of the width
    double angle_rad;  ///< of the lowest nosing
    double rise_per_radian_m;
  };
  static std::optional<Axis> find_axis(const detect::Stairway& stairway);
  Eigen::Vector3d unroll(const Eigen::Vector3d& p_base) const;

  Eigen::Vector2d origin_;
  Eigen::Vector2d ascent_;
  double turn_sign_ = 0.0;
  std::optional<Axis> axis_;  // of a spiral
  double half_width_m_ = 0.0;
  double foot_m_ = 0.0;
  std::vector<Eigen::Vector3d> nosings_;
};

}  // namespace stairway::tools
