// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "tools/sim/furniture.hpp"

#include <algorithm>
#include <cmath>

namespace stairway::sim {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

struct KindEntry {
  FurnitureKind kind;
  std::string_view name;
  std::array<double, 3> size;
};

constexpr std::array<KindEntry, kFurnitureKinds> kKinds{{
    {FurnitureKind::Box, "box", {0.5, 0.4, 0.35}},
    {FurnitureKind::Wall, "wall", {2.0, 0.12, 2.4}},
    {FurnitureKind::Column, "column", {0.35, 0.35, 2.8}},
    {FurnitureKind::Table, "table", {1.4, 0.8, 0.74}},
    {FurnitureKind::Chair, "chair", {0.45, 0.45, 0.85}},
    {FurnitureKind::Shelf, "shelf", {0.35, 1.0, 1.8}},
    {FurnitureKind::Pallet, "pallet", {1.2, 0.8, 0.144}},
    {FurnitureKind::Bench, "bench", {0.4, 1.5, 0.45}},
    {FurnitureKind::Radiator, "radiator", {0.1, 1.0, 0.6}},
    {FurnitureKind::DoorFrame, "door-frame", {0.15, 1.1, 2.1}},
    {FurnitureKind::DoorStep, "door-step", {0.3, 1.0, 0.06}},
    {FurnitureKind::Ramp, "ramp", {2.5, 1.2, 0.5}},
    {FurnitureKind::Bleachers, "bleachers", {3.2, 3.0, 1.6}},
    {FurnitureKind::Platform, "platform", {0.9, 1.5, 0.36}},
    {FurnitureKind::Kerb, "kerb", {1.2, 3.0, 0.12}},
    {FurnitureKind::ChairRows, "chair-rows", {2.7, 2.0, 0.85}},
}};

const KindEntry& entry(FurnitureKind kind) {
  return *std::find_if(kKinds.begin(), kKinds.end(), [&](const KindEntry& e) { return e.kind == kind; });
}

// A box given by its corners, in the piece's own frame: x and y from the middle, z from the floor.
void add_block(Mesh& mesh, const Vector3d& low, const Vector3d& high) {
  const Vector3d size = high - low;
  mesh.add_box((low + size / 2).head<2>(), low.z(), size, 0.0);
}

void add_legs(Mesh& mesh, const Vector3d& size, double top_m) {
  const double inset = 0.03;
  for (const double sx : {-1.0, 1.0}) {
    for (const double sy : {-1.0, 1.0}) {
      mesh.add_box(Vector2d{sx * (size.x() / 2 - inset), sy * (size.y() / 2 - inset)}, 0.0, Vector3d{0.04, 0.04, top_m},
                   0.0);
    }
  }
}

void add_table(Mesh& mesh, const Vector3d& size) {
  const double thickness = 0.03;
  mesh.add_box(Vector2d::Zero(), size.z() - thickness, Vector3d{size.x(), size.y(), thickness}, 0.0);
  add_legs(mesh, size, size.z() - thickness);
}

void add_chair(Mesh& mesh, const Vector3d& size) {
  const double seat = 0.53 * size.z();
  add_table(mesh, {size.x(), size.y(), seat});
  add_block(mesh, {-size.x() / 2, -size.y() / 2, seat}, {-size.x() / 2 + 0.03, size.y() / 2, size.z()});
}

// Where the middle of thing `i` of `count` lies that fill a length from end to end.
double spread(int i, int count, double length_m, double thing_m) {
  return count < 2 ? 0.0 : (length_m - thing_m) * (static_cast<double>(i) / (count - 1) - 0.5);
}

void add_chair_rows(Mesh& mesh, const Vector3d& size) {
  constexpr double kRow_m = 0.85;
  constexpr double kSeat_m = 0.45;
  const int rows = std::max(1, static_cast<int>(size.x() / kRow_m));
  const int seats = std::max(1, static_cast<int>(size.y() / (kSeat_m + 0.05)));
  for (int row = 0; row < rows; ++row) {
    for (int seat = 0; seat < seats; ++seat) {
      Mesh chair;
      add_chair(chair, {kSeat_m, kSeat_m, size.z()});
      mesh.append(chair, Eigen::Isometry3d{Eigen::Translation3d{spread(row, rows, size.x(), kSeat_m),
                                                                spread(seat, seats, size.y(), kSeat_m), 0.0}});
    }
  }
}

void add_shelf(Mesh& mesh, const Vector3d& size) {
  const double board = 0.025;
  const Vector3d half{size.x() / 2, size.y() / 2, 0.0};
  const int boards = std::max(2, static_cast<int>(std::lround(size.z() / 0.36)) + 1);
  for (const double side : {-1.0, 1.0}) {
    mesh.add_box(Vector2d{0.0, side * (half.y() - board / 2)}, 0.0, Vector3d{size.x(), board, size.z()}, 0.0);
  }
  add_block(mesh, {-half.x(), -half.y(), 0.0}, {-half.x() + 0.01, half.y(), size.z()});
  for (int i = 0; i < boards; ++i) {
    const double z = (size.z() - board) * i / (boards - 1);
    add_block(mesh, {-half.x(), -half.y() + board, z}, {half.x(), half.y() - board, z + board});
  }
}

void add_pallet(Mesh& mesh, const Vector3d& size) {
  const double board = 0.15 * size.z();
  for (const double side : {-0.45, 0.0, 0.45}) {
    mesh.add_box(Vector2d{0.0, side * size.y()}, 0.0, Vector3d{size.x(), 0.1 * size.y(), size.z() - board}, 0.0);
  }
  for (int i = 0; i < 5; ++i) {
    mesh.add_box(Vector2d{(i - 2) * 0.22 * size.x(), 0.0}, size.z() - board, Vector3d{0.12 * size.x(), size.y(), board},
                 0.0);
  }
}

void add_bench(Mesh& mesh, const Vector3d& size) {
  const double thickness = 0.05;
  mesh.add_box(Vector2d::Zero(), size.z() - thickness, Vector3d{size.x(), size.y(), thickness}, 0.0);
  for (const double side : {-0.4, 0.4}) {
    mesh.add_box(Vector2d{0.0, side * size.y()}, 0.0, Vector3d{0.9 * size.x(), 0.05, size.z() - thickness}, 0.0);
  }
}

void add_radiator(Mesh& mesh, const Vector3d& size) {
  const int ribs = std::max(2, static_cast<int>(size.y() / 0.08));
  for (int i = 0; i < ribs; ++i) {
    mesh.add_box(Vector2d{0.0, size.y() * ((i + 0.5) / ribs - 0.5)}, 0.12, Vector3d{size.x(), 0.05, size.z() - 0.12},
                 0.0);
  }
}

void add_door_frame(Mesh& mesh, const Vector3d& size) {
  const double beam = 0.1;
  for (const double side : {-1.0, 1.0}) {
    mesh.add_box(Vector2d{0.0, side * (size.y() - beam) / 2}, 0.0, Vector3d{size.x(), beam, size.z() - beam}, 0.0);
  }
  mesh.add_box(Vector2d::Zero(), size.z() - beam, Vector3d{size.x(), size.y(), beam}, 0.0);
}

void add_ramp(Mesh& mesh, const Vector3d& size) {
  const double x = size.x() / 2;
  const double y = size.y() / 2;
  const double z = size.z();
  mesh.add_polygon(std::array{Vector3d{-x, -y, 0}, Vector3d{x, -y, z}, Vector3d{x, y, z}, Vector3d{-x, y, 0}});
  mesh.add_polygon(std::array{Vector3d{x, -y, 0}, Vector3d{x, y, 0}, Vector3d{x, y, z}, Vector3d{x, -y, z}});
  for (const double side : {-y, y}) {
    mesh.add_polygon(std::array{Vector3d{-x, side, 0}, Vector3d{x, side, 0}, Vector3d{x, side, z}});
  }
}

void add_equal_steps(Mesh& mesh, const Vector3d& size, int steps) {
  for (int i = 0; i < steps; ++i) {
    add_block(mesh, {-size.x() / 2 + i * size.x() / steps, -size.y() / 2, 0.0},
              {-size.x() / 2 + (i + 1) * size.x() / steps, size.y() / 2, size.z() * (i + 1) / steps});
  }
}

}  // namespace

std::string_view to_string(FurnitureKind kind) { return entry(kind).name; }

std::optional<FurnitureKind> furniture_kind(std::string_view name) {
  for (const auto& e : kKinds) {
    if (e.name == name) return e.kind;
  }
  return std::nullopt;
}

Vector3d usual_size(FurnitureKind kind) { return Vector3d{entry(kind).size.data()}; }

Mesh build_furniture(const Furniture& piece) {
  Mesh mesh;
  const Vector3d& size = piece.size;
  switch (piece.kind) {
    case FurnitureKind::Box:
    case FurnitureKind::Wall:
    case FurnitureKind::DoorStep:
    case FurnitureKind::Kerb:
      mesh.add_box(Vector2d::Zero(), 0.0, size, 0.0);
      break;
    case FurnitureKind::Column:
      mesh.add_post(Vector2d::Zero(), 0.0, size.z(), size.x() / 2, 20);
      break;
    case FurnitureKind::Table:
      add_table(mesh, size);
      break;
    case FurnitureKind::Chair:
      add_chair(mesh, size);
      break;
    case FurnitureKind::Shelf:
      add_shelf(mesh, size);
      break;
    case FurnitureKind::Pallet:
      add_pallet(mesh, size);
      break;
    case FurnitureKind::Bench:
      add_bench(mesh, size);
      break;
    case FurnitureKind::Radiator:
      add_radiator(mesh, size);
      break;
    case FurnitureKind::DoorFrame:
      add_door_frame(mesh, size);
      break;
    case FurnitureKind::Ramp:
      add_ramp(mesh, size);
      break;
    case FurnitureKind::Bleachers:
      add_equal_steps(mesh, size, 4);
      break;
    case FurnitureKind::Platform:
      add_equal_steps(mesh, size, 2);
      break;
    case FurnitureKind::ChairRows:
      add_chair_rows(mesh, size);
      break;
  }
  mesh.share_coplanar_surfaces();
  Eigen::Isometry3d T_scene_piece = Eigen::Isometry3d::Identity();
  T_scene_piece.translate(Vector3d{piece.position.x(), piece.position.y(), piece.level_m});
  T_scene_piece.rotate(Eigen::AngleAxisd{piece.yaw_rad, Vector3d::UnitZ()});
  Mesh placed;
  placed.append(mesh, T_scene_piece);
  return placed;
}

}  // namespace stairway::sim
