// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <vector>

namespace stairway::sim {

/// A convex polygon in the horizontal plane, counter-clockwise from above [m].
using Outline = std::vector<Eigen::Vector2d>;

/// A rectangle of `size` about `center`, its first side turned by `yaw_rad` from x.
Outline rectangle(const Eigen::Vector2d& center, const Eigen::Vector2d& size, double yaw_rad);

/// The rectangle along x and y between two opposite corners.
Outline rectangle_between(const Eigen::Vector2d& corner, const Eigen::Vector2d& opposite);

/// The smallest convex polygon around all points, to 0.1 um; fewer than three corners when they lie on one line.
Outline convex_hull(std::vector<Eigen::Vector2d> points);

/// The parts of `from` outside `hole`, as convex pieces that do not overlap.
std::vector<Outline> subtract(const Outline& from, const Outline& hole);

/// Takes `hole` out of every piece.
void cut(std::vector<Outline>& pieces, const Outline& hole);

/// Whether the two share more than a border.
bool overlap(const Outline& a, const Outline& b);
bool overlap_any(const Outline& outline, const std::vector<Outline>& others);

/// The same polygon with every side moved outward by `margin_m`; corners stay sharp.
Outline grown(const Outline& outline, double margin_m);

double area(const Outline& outline);

}  // namespace stairway::sim
