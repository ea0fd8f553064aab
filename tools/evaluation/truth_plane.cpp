// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "tools/evaluation/truth_plane.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <numeric>
#include <utility>

namespace stairway::evaluation {
namespace {

constexpr double kTiny_m = 1e-6;
// Files hold corners in single precision, some in six or seven digits.
constexpr double kSamePlace_m = 1e-5;

double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }

// Whether two edges lie on one line and overlap by more than a point.
bool overlap(const Eigen::Vector3d& a0, const Eigen::Vector3d& a1, const Eigen::Vector3d& b0,
             const Eigen::Vector3d& b1) {
  const double length = (a1 - a0).norm();
  const Eigen::Vector3d along = (a1 - a0) / length;
  const auto off_line = [&](const Eigen::Vector3d& p) { return along.cross(p - a0).norm(); };
  if (off_line(b0) > kSamePlace_m || off_line(b1) > kSamePlace_m) return false;
  const double s0 = along.dot(b0 - a0);
  const double s1 = along.dot(b1 - a0);
  return std::min(length, std::max(s0, s1)) - std::max(0.0, std::min(s0, s1)) > kSamePlace_m;
}

bool share_part_of_an_edge(const sim::Triangle& a, const sim::Triangle& b) {
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t k = 0; k < 3; ++k)
      if (overlap(a.corners[i], a.corners[(i + 1) % 3], b.corners[k], b.corners[(k + 1) % 3])) return true;
  return false;
}

bool lies_in_plane_of(const sim::Triangle& a, const sim::Triangle& b) {
  const Eigen::Vector3d normal = b.normal();
  return std::ranges::all_of(a.corners, [&](const Eigen::Vector3d& corner) {
    return std::abs(normal.dot(corner - b.corners[0])) <= kSamePlace_m;
  });
}

// The normal of a sliver is far less exact than its corners: it is enough that one lies in the plane of the other.
bool are_coplanar(const sim::Triangle& a, const sim::Triangle& b) {
  return lies_in_plane_of(a, b) || lies_in_plane_of(b, a);
}

Eigen::Vector2d nearest_on_edge(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& p) {
  const Eigen::Vector2d edge = b - a;
  return a + std::clamp((p - a).dot(edge) / edge.squaredNorm(), 0.0, 1.0) * edge;
}

}  // namespace

TruthPlane::TruthPlane(std::span<const sim::Triangle> triangles)
    : origin_(triangles.front().corners[0]),
      normal_(triangles.front().normal()),
      u_((triangles.front().corners[1] - origin_).normalized()),
      v_(normal_.cross(u_)) {
  low_.setConstant(std::numeric_limits<double>::infinity());
  high_ = -low_;
  for (const sim::Triangle& triangle : triangles) {
    FlatTriangle flat;
    for (std::size_t i = 0; i < 3; ++i) {
      flat[i] = flatten(triangle.corners[i]);
      low_ = low_.cwiseMin(flat[i]);
      high_ = high_.cwiseMax(flat[i]);
    }
    if (cross(flat[1] - flat[0], flat[2] - flat[0]) < 0) std::swap(flat[1], flat[2]);
    triangles_.push_back(flat);
  }
}

Eigen::Vector2d TruthPlane::flatten(const Eigen::Vector3d& point) const {
  return {u_.dot(point - origin_), v_.dot(point - origin_)};
}

Eigen::Vector3d TruthPlane::place(const Eigen::Vector2d& flat) const { return origin_ + flat.x() * u_ + flat.y() * v_; }

bool TruthPlane::holds(const Eigen::Vector2d& flat) const {
  return std::ranges::any_of(triangles_, [&](const FlatTriangle& t) {
    for (std::size_t i = 0; i < 3; ++i) {
      const Eigen::Vector2d edge = t[(i + 1) % 3] - t[i];
      if (cross(edge, flat - t[i]) < -kTiny_m * edge.norm()) return false;
    }
    return true;
  });
}

Eigen::Vector2d TruthPlane::nearest(const Eigen::Vector2d& flat) const {
  if (holds(flat)) return flat;
  Eigen::Vector2d best = triangles_.front()[0];
  for (const FlatTriangle& t : triangles_) {
    for (std::size_t i = 0; i < 3; ++i) {
      const Eigen::Vector2d candidate = nearest_on_edge(t[i], t[(i + 1) % 3], flat);
      if ((candidate - flat).squaredNorm() < (best - flat).squaredNorm()) best = candidate;
    }
  }
  return best;
}

std::vector<Eigen::Vector2d> TruthPlane::raster(double step_m, double margin_m) const {
  std::vector<Eigen::Vector2d> around;
  for (int i = 0; i < 8; ++i) {
    const double angle = i * std::numbers::pi / 4;
    around.emplace_back(margin_m * std::cos(angle), margin_m * std::sin(angle));
  }
  std::vector<Eigen::Vector2d> places;
  const Eigen::Array2d span = (high_ - low_).array() - 2 * margin_m + kTiny_m;
  for (int i = 0; i * step_m <= span.x(); ++i) {
    for (int k = 0; k * step_m <= span.y(); ++k) {
      const Eigen::Vector2d place = low_ + Eigen::Vector2d(margin_m + i * step_m, margin_m + k * step_m);
      if (holds(place) && std::ranges::all_of(around, [&](const auto& d) { return holds(place + d); }))
        places.push_back(place);
    }
  }
  return places;
}

std::vector<TruthPlane> truth_planes(std::span<const sim::Triangle> triangles) {
  std::vector<std::size_t> leader(triangles.size());
  std::iota(leader.begin(), leader.end(), 0U);
  const auto find = [&](std::size_t i) {
    while (leader[i] != i) i = leader[i] = leader[leader[i]];
    return i;
  };
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k) {
      if (!are_coplanar(triangles[i], triangles[k])) continue;
      const auto [first, last] = std::minmax({find(i), find(k)});
      if (first != last && share_part_of_an_edge(triangles[i], triangles[k])) leader[last] = first;
    }
  }
  std::vector<std::vector<sim::Triangle>> groups(triangles.size());
  for (std::size_t i = 0; i < triangles.size(); ++i) groups[find(i)].push_back(triangles[i]);
  std::vector<TruthPlane> planes;
  for (const auto& group : groups)
    if (!group.empty()) planes.emplace_back(group);
  return planes;
}

}  // namespace stairway::evaluation
