// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "tools/sim/random_scenes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>

#include "tools/sim/random_flight.hpp"
#include "tools/sim/random_layout.hpp"

namespace stairway::sim {
namespace {

using Eigen::Vector2d;

constexpr std::uint64_t kStairStream = 1;
constexpr std::uint64_t kRoomStream = 2;

StairSpec random_flight(Random& random) {
  StairSpec spec;
  spec.steps = random.integer(4, 12);
  draw_usual_steps(spec, random);
  spec.width_m = random.uniform(0.8, 1.6);
  spec.open_risers = random.chance(0.3);
  draw_fittings(spec, random);
  place_before_robot(spec, 0.6, 4.0, random);
  return spec;
}

struct Kind {
  std::string_view name;
  SceneSpec (*make)(std::uint64_t seed);
};

constexpr std::array kKinds{Kind{"random-stairs", random_stair_scene},
                            Kind{"random-spiral", random_spiral_scene},
                            Kind{"random-descending", random_descending_scene},
                            Kind{"random-inverted-descending", random_inverted_descending_scene},
                            Kind{"random-mid-landing", random_mid_landing_scene},
                            Kind{"random-room", random_room}};

}  // namespace

SceneSpec random_stair_scene(std::uint64_t seed) {
  Random random{seed, kStairStream};
  SceneSpec spec;
  spec.name = fmt::format("random-stairs:{}", seed);
  spec.stairs = {random_flight(random)};
  surround(spec, random);
  return spec;
}

SceneSpec random_room(std::uint64_t seed) {
  static constexpr std::array kThings{FurnitureKind::Box,      FurnitureKind::Box,       FurnitureKind::Column,
                                      FurnitureKind::Table,    FurnitureKind::Chair,     FurnitureKind::Shelf,
                                      FurnitureKind::Shelf,    FurnitureKind::Pallet,    FurnitureKind::Bench,
                                      FurnitureKind::Wall,     FurnitureKind::Radiator,  FurnitureKind::Ramp,
                                      FurnitureKind::DoorStep, FurnitureKind::DoorFrame, FurnitureKind::Bleachers,
                                      FurnitureKind::Platform, FurnitureKind::Kerb,      FurnitureKind::ChairRows};
  Random random{seed, kRoomStream};
  SceneSpec spec;
  spec.name = fmt::format("random-room:{}", seed);
  spec.room = room_around({Vector2d{-1.5, -1.5}, Vector2d{1.5, 1.5}}, random);
  spec.furniture = furnish(spec.room, kThings, random.integer(8, 24), {robot_space()}, random);
  return spec;
}

std::optional<SceneSpec> random_scene(std::string_view name) {
  const std::size_t colon = name.find(':');
  if (colon == std::string_view::npos) return std::nullopt;
  std::uint64_t seed = 0;
  const char* const end = name.data() + name.size();
  const auto [read_to, error] = std::from_chars(name.data() + colon + 1, end, seed);
  if (error != std::errc{} || read_to != end) return std::nullopt;
  const auto kind = std::find_if(kKinds.begin(), kKinds.end(),
                                 [prefix = name.substr(0, colon)](const Kind& k) { return k.name == prefix; });
  if (kind == kKinds.end()) return std::nullopt;
  return kind->make(seed);
}

std::vector<std::string_view> random_scene_kinds() {
  std::vector<std::string_view> names;
  for (const Kind& kind : kKinds) names.push_back(kind.name);
  return names;
}

}  // namespace stairway::sim
