// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "tools/sim/helmet_scene.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "tools/sim/angles.hpp"
#include "tools/sim/random_layout.hpp"

namespace stairway::sim {
namespace {

using Eigen::Vector2d;

constexpr std::uint64_t kHelmetStream = 7;
constexpr double kGravityError_rad = 1.0 * kDegree;

StairSpec random_flight(bool is_descending, Random& random) {
  StairSpec spec;
  spec.descending = is_descending;
  spec.steps = random.integer(5, 12);
  do {
    spec.height_m = random.uniform(0.13, 0.19);
    spec.depth_m = random.uniform(0.25, 0.34);
  } while (std::abs(2 * spec.height_m + spec.depth_m - 0.63) > 0.06);
  spec.width_m = random.uniform(0.9, 2.5);
  spec.open_risers = random.chance(0.15);
  spec.overhang_m = random.chance(0.5) ? random.uniform(0.0, 0.03) : 0.0;
  spec.railing_left = random.chance(0.35);
  spec.railing_right = random.chance(0.35);
  spec.landing_m = random.uniform(0.8, 2.0);
  const double skew = random.uniform(-25 * kDegree, 25 * kDegree);
  const double distance = is_descending ? random.uniform(0.4, 1.0) : random.uniform(0.7, 1.8);
  const double aside = random.uniform(-0.25, 0.25) * spec.width_m;
  const Vector2d across = unit(skew + std::numbers::pi / 2);
  spec.position = Vector2d{distance, 0.0} + aside * across;
  spec.heading_rad = is_descending ? std::remainder(skew + std::numbers::pi, 2 * std::numbers::pi) : skew;
  return spec;
}

// A corridor, a hall, or a place so wide that its walls do not count.
Room random_surroundings(const Outline& outline, Random& random) {
  Room room = room_around(outline, random);
  const int kind = random.integer(0, 2);
  const double beside = kind == 0 ? 0.1 : kind == 1 ? 1.5 : 6.0;
  room.low.y() = -0.5;
  room.high.y() = 0.5;
  for (const auto& p : outline) {
    room.low.y() = std::min(room.low.y(), p.y());
    room.high.y() = std::max(room.high.y(), p.y());
  }
  room.low.y() -= beside * random.uniform(0.5, 1.0);
  room.high.y() += beside * random.uniform(0.5, 1.0);
  if (kind == 2) room.high.x() += 6.0;
  return room;
}

// Slabs of a pavement, some of which have come up a little.
void pave(SceneSpec& spec, const std::vector<Outline>& taken, Random& random) {
  constexpr double kSlab_m = 0.5;
  for (double x = 0.5; x < std::min(5.0, spec.room.high.x() - kSlab_m); x += kSlab_m) {
    for (double y = std::max(-2.0, spec.room.low.y()); y < std::min(2.0, spec.room.high.y()) - kSlab_m; y += kSlab_m) {
      if (!random.chance(0.3)) continue;
      Furniture slab;
      slab.position = {x + kSlab_m / 2, y + kSlab_m / 2};
      slab.size = {kSlab_m, kSlab_m, random.uniform(0.006, 0.012)};
      if (!overlap_any(slab.footprint(), taken)) spec.furniture.push_back(slab);
    }
  }
}

CameraPose random_pose(HelmetSubject subject, Random& random) {
  CameraPose pose;
  pose.position.z() = random.uniform(1.60, 1.80);
  pose.yaw_rad = random.uniform(-12 * kDegree, 12 * kDegree);
  pose.pitch_down_rad = subject == HelmetSubject::Descending ? random.uniform(32 * kDegree, 48 * kDegree)
                                                             : random.uniform(22 * kDegree, 40 * kDegree);
  pose.roll_rad = 3 * kDegree * random.normal();
  return pose;
}

bool shows_stairs(const HelmetScene& scene) {
  constexpr int kLeastNosings = 4;
  const std::vector<bool> seen = nosings_in_view(build_flight(scene.scene.stairs.front()).truth, scene.pose);
  return std::count(seen.begin(), seen.end(), true) >= kLeastNosings;
}

void furnish_without_stairs(SceneSpec& spec, Random& random) {
  static constexpr std::array kThings{
      FurnitureKind::Box,       FurnitureKind::Box,      FurnitureKind::Column, FurnitureKind::Table,
      FurnitureKind::Chair,     FurnitureKind::Shelf,    FurnitureKind::Pallet, FurnitureKind::Bench,
      FurnitureKind::Wall,      FurnitureKind::Radiator, FurnitureKind::Ramp,   FurnitureKind::DoorStep,
      FurnitureKind::DoorFrame, FurnitureKind::Platform, FurnitureKind::Kerb,   FurnitureKind::ChairRows};
  spec.room = random_surroundings({{-0.5, -0.8}, {3.5, -0.8}, {3.5, 0.8}, {-0.5, 0.8}}, random);
  spec.furniture = furnish(spec.room, kThings, random.integer(4, 12), {robot_space()}, random);
}

}  // namespace

HelmetScene random_helmet_scene(std::uint64_t seed, HelmetSubject subject) {
  Random random{seed, kHelmetStream + static_cast<std::uint64_t>(subject)};
  HelmetScene result;
  SceneSpec& spec = result.scene;
  spec.name = fmt::format("helmet:{}", seed);
  std::vector<Outline> taken{robot_space()};
  if (subject == HelmetSubject::Nothing) {
    result.pose = random_pose(subject, random);
    furnish_without_stairs(spec, random);
  } else {
    Outline footprint;
    do {
      spec.stairs = {random_flight(subject == HelmetSubject::Descending, random)};
      result.pose = random_pose(subject, random);
      footprint = build_flight(spec.stairs.front()).footprint;
    } while (overlap(footprint, rectangle(Vector2d::Zero(), {0.5, 0.5}, 0.0)) || !shows_stairs(result));
    spec.room = random_surroundings(footprint, random);
    spec.furniture = furnish_around(spec.room, {footprint}, random);
    taken.push_back(grown(footprint, 0.02));
  }
  for (const Furniture& piece : spec.furniture) taken.push_back(piece.footprint());
  if (random.chance(0.5)) pave(spec, taken, random);
  result.assumed = result.pose;
  result.assumed.pitch_down_rad += kGravityError_rad * random.normal();
  result.assumed.roll_rad += kGravityError_rad * random.normal();
  return result;
}

std::vector<bool> nosings_in_view(const detect::Stairway& stairway, const CameraPose& pose) {
  constexpr double kFarthest_m = 4.2;
  const Eigen::Isometry3d T_camera_scene = pose.T_scene_camera().inverse();
  std::vector<bool> seen;
  for (const detect::Nosing& nosing : stairway.nosings) {
    const Eigen::Vector3d p_camera = T_camera_scene * ((nosing.left + nosing.right) / 2);
    seen.push_back(p_camera.z() < kFarthest_m && CameraIntrinsics{}.pixel(p_camera).has_value());
  }
  return seen;
}

}  // namespace stairway::sim
