// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "tools/sim/outline.hpp"

#include <Eigen/Geometry>
#include <algorithm>

namespace stairway::sim {
namespace {

constexpr double kSmallestArea_m2 = 1e-9;
constexpr double kResolution_m = 1e-7;

double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }

// Keeps what lies left of the line from a to b.
Outline clip(const Outline& outline, const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  Outline kept;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Eigen::Vector2d& p = outline[i];
    const Eigen::Vector2d& q = outline[(i + 1) % outline.size()];
    const double side_p = cross(b - a, p - a);
    const double side_q = cross(b - a, q - a);
    if (side_p >= 0) kept.push_back(p);
    if ((side_p > 0 && side_q < 0) || (side_p < 0 && side_q > 0))
      kept.push_back(p + (q - p) * side_p / (side_p - side_q));
  }
  return kept;
}

}  // namespace

Outline rectangle(const Eigen::Vector2d& center, const Eigen::Vector2d& size, double yaw_rad) {
  const Eigen::Rotation2Dd turn{yaw_rad};
  const Eigen::Vector2d x = turn * Eigen::Vector2d{size.x() / 2, 0};
  const Eigen::Vector2d y = turn * Eigen::Vector2d{0, size.y() / 2};
  return {center - x - y, center + x - y, center + x + y, center - x + y};
}

Outline rectangle_between(const Eigen::Vector2d& corner, const Eigen::Vector2d& opposite) {
  return rectangle((corner + opposite) / 2, (opposite - corner).cwiseAbs(), 0.0);
}

Outline convex_hull(std::vector<Eigen::Vector2d> points) {
  // Points of one vertical side differ in x by rounding; sorted by that they would jump up and down the side.
  for (Eigen::Vector2d& p : points) p = (p / kResolution_m).array().round() * kResolution_m;
  std::sort(points.begin(), points.end(),
            [](const auto& a, const auto& b) { return a.x() < b.x() || (a.x() == b.x() && a.y() < b.y()); });
  Outline hull;
  const auto add_chain = [&](auto begin, auto end) {
    const std::size_t base = hull.size();
    for (auto it = begin; it != end; ++it) {
      while (hull.size() >= base + 2 && cross(hull.back() - hull[hull.size() - 2], *it - hull.back()) <= 1e-9)
        hull.pop_back();
      hull.push_back(*it);
    }
    if (!hull.empty()) hull.pop_back();
  };
  add_chain(points.begin(), points.end());
  add_chain(points.rbegin(), points.rend());
  return hull;
}

std::vector<Outline> subtract(const Outline& from, const Outline& hole) {
  std::vector<Outline> pieces;
  Outline rest = from;
  for (std::size_t i = 0; i < hole.size() && !rest.empty(); ++i) {
    const Eigen::Vector2d& a = hole[i];
    const Eigen::Vector2d& b = hole[(i + 1) % hole.size()];
    if (Outline outside = clip(rest, b, a); area(outside) > kSmallestArea_m2) pieces.push_back(std::move(outside));
    rest = clip(rest, a, b);
  }
  return pieces;
}

void cut(std::vector<Outline>& pieces, const Outline& hole) {
  std::vector<Outline> rest;
  for (const auto& piece : pieces) {
    for (auto& part : subtract(piece, hole)) rest.push_back(std::move(part));
  }
  pieces = std::move(rest);
}

bool overlap(const Outline& a, const Outline& b) {
  Outline common = a;
  for (std::size_t i = 0; i < b.size() && !common.empty(); ++i) common = clip(common, b[i], b[(i + 1) % b.size()]);
  return area(common) > kSmallestArea_m2;
}

bool overlap_any(const Outline& outline, const std::vector<Outline>& others) {
  return std::any_of(others.begin(), others.end(), [&](const Outline& other) { return overlap(outline, other); });
}

Outline grown(const Outline& outline, double margin_m) {
  Outline result;
  const std::size_t n = outline.size();
  for (std::size_t i = 0; i < n; ++i) {
    const Eigen::Vector2d before = (outline[i] - outline[(i + n - 1) % n]).normalized();
    const Eigen::Vector2d after = (outline[(i + 1) % n] - outline[i]).normalized();
    const Eigen::Vector2d out_before{before.y(), -before.x()};
    const Eigen::Vector2d out_after{after.y(), -after.x()};
    result.push_back(outline[i] + margin_m * (out_before + out_after) / (1.0 + out_before.dot(out_after)));
  }
  return result;
}

double area(const Outline& outline) {
  double doubled = 0.0;
  for (std::size_t i = 0; i < outline.size(); ++i) doubled += cross(outline[i], outline[(i + 1) % outline.size()]);
  return doubled / 2;
}

}  // namespace stairway::sim
