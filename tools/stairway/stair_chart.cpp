// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "tools/stairway/stair_chart.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace stairway::tools {
namespace {

double angle_of(const Eigen::Vector2d& v) { return std::atan2(v.y(), v.x()); }

}  // namespace

StairChart::StairChart(const detect::Stairway& stairway)
    : origin_(stairway.nosings.front().middle().head<2>()),
      ascent_(std::cos(stairway.heading), std::sin(stairway.heading)),
      turn_sign_(stairway.turn_per_step < 0.0 ? -1.0 : 1.0),
      axis_(find_axis(stairway)),
      half_width_m_(0.5 * stairway.width),
      foot_m_(stairway.nosings.front().left.z() - stairway.step_height) {
  for (const detect::Nosing& nosing : stairway.nosings) nosings_.push_back(to_chart(nosing.middle()));
}

// The point nearest to the lines of all nosings, seen from above.
std::optional<StairChart::Axis> StairChart::find_axis(const detect::Stairway& stairway) {
  if (stairway.kind != detect::StairwayKind::Spiral || stairway.turn_per_step == 0.0) return std::nullopt;
  Eigen::Matrix2d A = Eigen::Matrix2d::Zero();
  Eigen::Vector2d b = Eigen::Vector2d::Zero();
  for (const detect::Nosing& nosing : stairway.nosings) {
    const Eigen::Vector2d along = (nosing.right - nosing.left).head<2>().normalized();
    const Eigen::Matrix2d across = Eigen::Matrix2d::Identity() - along * along.transpose();
    A += across;
    b += across * nosing.left.head<2>();
  }
  if (A.determinant() < 1e-9) return std::nullopt;
  const Eigen::Vector2d centre = A.inverse() * b;
  const Eigen::Vector2d first = stairway.nosings.front().middle().head<2>() - centre;
  return Axis{centre, first.norm(), angle_of(first), stairway.step_height / std::abs(stairway.turn_per_step)};
}

Eigen::Vector3d StairChart::to_chart(const Eigen::Vector3d& p_base) const {
  if (axis_) return unroll(p_base);
  const Eigen::Vector2d p = p_base.head<2>() - origin_;
  return {p.dot(ascent_), ascent_.x() * p.y() - ascent_.y() * p.x(), p_base.z()};
}

Eigen::Vector3d StairChart::unroll(const Eigen::Vector3d& p_base) const {
  constexpr double kTurn = 2.0 * std::numbers::pi;
  const Eigen::Vector2d p = p_base.head<2>() - axis_->centre;
  // A spiral may pass the same direction more than once; the height tells the turns apart.
  const double expected = (p_base.z() - foot_m_) / axis_->rise_per_radian_m;
  const double angle = turn_sign_ * (angle_of(p) - axis_->angle_rad);
  const double unwrapped = angle + kTurn * std::round((expected - angle) / kTurn);
  return {axis_->radius_m * unwrapped, turn_sign_ * (axis_->radius_m - p.norm()), p_base.z()};
}

StairChart::Part StairChart::part_at(const Eigen::Vector3d& p, double tolerance_m) const {
  if (std::abs(p.y()) > half_width_m_ + tolerance_m) return Part::None;
  for (std::size_t i = 0; i < nosings_.size(); ++i) {
    const Eigen::Vector3d& nosing = nosings_[i];
    const double below = i > 0 ? nosings_[i - 1].z() : foot_m_;
    const bool is_last = i + 1 == nosings_.size();
    if (std::abs(p.z() - nosing.z()) < tolerance_m && p.x() > nosing.x() - tolerance_m && !is_last &&
        p.x() < nosings_[i + 1].x())
      return Part::Tread;
    // A riser may stand back behind the overhang of its tread.
    if (std::abs(p.x() - nosing.x()) < tolerance_m && p.z() > below && p.z() < nosing.z() + tolerance_m)
      return Part::Riser;
  }
  return Part::None;
}

}  // namespace stairway::tools
