// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "tools/sim/mesh.hpp"

#include <cmath>
#include <numbers>

namespace stairway::sim {
namespace {

constexpr double kSamePlane_m = 1e-6;

Eigen::Vector3d at_height(const Eigen::Vector2d& p, double z_m) { return {p.x(), p.y(), z_m}; }

bool is_coplanar(const Triangle& a, const Triangle& b) {
  const Eigen::Vector3d normal = a.normal();
  for (const auto& corner : b.corners) {
    if (std::abs(normal.dot(corner - a.corners[0])) > kSamePlane_m) return false;
  }
  return true;
}

}  // namespace

void Mesh::add_fan(std::span<const Eigen::Vector3d> corners, std::uint32_t surface) {
  for (std::size_t i = 2; i < corners.size(); ++i) {
    const Triangle triangle{{corners[0], corners[i - 1], corners[i]}, surface};
    const Eigen::Vector3d normal = (corners[i - 1] - corners[0]).cross(corners[i] - corners[0]);
    if (normal.squaredNorm() > 0) triangles_.push_back(triangle);
  }
}

void Mesh::add_polygon(std::span<const Eigen::Vector3d> corners) { add_fan(corners, surface_count_++); }

void Mesh::add_horizontal(const std::vector<Outline>& pieces, double z_m) {
  const std::uint32_t surface = surface_count_++;
  for (const auto& piece : pieces) {
    std::vector<Eigen::Vector3d> corners;
    for (const auto& p : piece) corners.push_back(at_height(p, z_m));
    add_fan(corners, surface);
  }
}

void Mesh::add_walls(const Outline& outline, double z_low_m, double z_high_m) {
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Eigen::Vector2d& a = outline[i];
    const Eigen::Vector2d& b = outline[(i + 1) % outline.size()];
    add_polygon(
        std::array{at_height(a, z_low_m), at_height(b, z_low_m), at_height(b, z_high_m), at_height(a, z_high_m)});
  }
}

void Mesh::add_prism(const Outline& outline, double z_low_m, double z_high_m) {
  add_walls(outline, z_low_m, z_high_m);
  add_horizontal(outline, z_low_m);
  add_horizontal(outline, z_high_m);
}

void Mesh::add_box(const Eigen::Vector2d& center, double z_low_m, const Eigen::Vector3d& size, double yaw_rad) {
  add_prism(rectangle(center, size.head<2>(), yaw_rad), z_low_m, z_low_m + size.z());
}

void Mesh::add_beam(const Eigen::Vector3d& from, const Eigen::Vector3d& to, double width_m, double height_m) {
  const Eigen::Vector3d along = (to - from).normalized();
  const Eigen::Vector3d side = (along.cross(Eigen::Vector3d::UnitZ()).normalized()) * (width_m / 2);
  const Eigen::Vector3d up = side.normalized().cross(along) * (height_m / 2);
  const std::array<Eigen::Vector3d, 4> section{side + up, up - side, -side - up, side - up};
  std::array<Eigen::Vector3d, 4> near_end;
  std::array<Eigen::Vector3d, 4> far_end;
  for (std::size_t i = 0; i < 4; ++i) {
    near_end[i] = from + section[i];
    far_end[i] = to + section[i];
  }
  add_polygon(near_end);
  add_polygon(far_end);
  for (std::size_t i = 0; i < 4; ++i) {
    const std::size_t j = (i + 1) % 4;
    add_polygon(std::array{near_end[i], near_end[j], far_end[j], far_end[i]});
  }
}

void Mesh::add_post(const Eigen::Vector2d& center, double z_low_m, double z_high_m, double radius_m, int sides) {
  Outline outline;
  for (int i = 0; i < sides; ++i) {
    const double angle = 2 * std::numbers::pi * i / sides;
    outline.push_back(center + radius_m * Eigen::Vector2d{std::cos(angle), std::sin(angle)});
  }
  add_prism(outline, z_low_m, z_high_m);
}

void Mesh::append(const Mesh& other, const Eigen::Isometry3d& T_this_other) {
  for (Triangle triangle : other.triangles_) {
    for (auto& corner : triangle.corners) corner = T_this_other * corner;
    triangle.surface += surface_count_;
    triangles_.push_back(triangle);
  }
  surface_count_ += other.surface_count_;
}

void Mesh::share_coplanar_surfaces() {
  std::vector<const Triangle*> representatives;
  std::vector<std::uint32_t> shared(surface_count_, surface_count_);
  for (const auto& triangle : triangles_) {
    if (shared[triangle.surface] != surface_count_) continue;
    std::uint32_t found = 0;
    while (found < representatives.size() && !is_coplanar(*representatives[found], triangle)) ++found;
    if (found == representatives.size()) representatives.push_back(&triangle);
    shared[triangle.surface] = found;
  }
  for (auto& triangle : triangles_) triangle.surface = shared[triangle.surface];
  surface_count_ = static_cast<std::uint32_t>(representatives.size());
}

}  // namespace stairway::sim
