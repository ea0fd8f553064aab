// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "tools/sim/building.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numbers>
#include <stdexcept>

#include "tools/sim/random_layout.hpp"

namespace stairway::sim {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr std::uint64_t kBuildingStream = 6;
constexpr double kBay_m = 6.4;        // along the corridor
constexpr double kRoomDepth_m = 5.0;  // away from it
constexpr double kCorridor_m = 2.2;
constexpr double kWall_m = 0.12;
constexpr double kSlab_m = 0.25;
constexpr double kDoor_m = 1.1;
constexpr double kDoorHeight_m = 2.1;
constexpr double kStairwellDoor_m = 2.4;
constexpr double kFoot_m = 1.5;  // from the stairwell's first wall to the first nosing
constexpr double kHalfLanding_m = 1.3;
constexpr double kLandingSlab_m = 0.2;
constexpr double kGap_m = 0.15;  // between the two flights of a stairwell
constexpr double kShortestLanding_m = 0.1;

// The space of one room, and on which side of the corridor it lies.
struct Bay {
  Vector2d low, high;
  double side;  // +1 left of the corridor, -1 right
  bool is_stairwell;

  Vector2d middle() const { return (low + high) / 2; }
  double at_corridor_m() const { return side > 0 ? low.y() : high.y(); }
};

// The measures that all dog-legs of a building share.
struct DogLeg {
  int steps;  // of one flight
  double height_m, depth_m, width_m;
  bool railing;

  double storey_m() const { return 2 * steps * height_m; }
  double run_m() const { return (steps - 1) * depth_m; }
};

DogLeg random_dog_leg(Random& random) {
  DogLeg leg{};
  leg.steps = random.integer(8, 9);
  leg.height_m = random.uniform(0.165, 0.185);
  leg.depth_m = random.uniform(0.27, 0.30);
  leg.width_m = random.uniform(1.1, 1.5);
  leg.railing = random.chance(0.5);
  return leg;
}

class Builder {
 public:
  explicit Builder(const BuildingSpec& spec) : spec_{spec}, random_{spec.seed, kBuildingStream} {
    leg_ = random_dog_leg(random_);
    building_.scene.name = fmt::format("building:{}", spec.seed);
    for (const double side : {1.0, -1.0}) {
      for (int i = 0; i < spec.rooms; ++i) bays_.push_back(make_bay(i, side));
    }
  }

  Building build() {
    add_slabs();
    for (int storey = 0; storey < spec_.storeys; ++storey) {
      const double z = storey * leg_.storey_m();
      add_walls(z);
      for (const Bay& bay : bays_) {
        if (!bay.is_stairwell) furnish_room(bay, z);
        stand(door_stand(bay, z));
      }
      for (const Bay& bay : bays_) {
        if (bay.is_stairwell && storey + 1 < spec_.storeys) add_dog_leg(bay, z);
      }
    }
    return std::move(building_);
  }

 private:
  Bay make_bay(int number, double side) const {
    const double y = kCorridor_m / 2;
    Bay bay{{number * kBay_m, side > 0 ? y : -y - kRoomDepth_m},
            {(number + 1) * kBay_m, side > 0 ? y + kRoomDepth_m : -y},
            side,
            false};
    bay.is_stairwell = (side > 0 && number == 0 && spec_.stairwells > 0) ||
                       (side < 0 && number == spec_.rooms - 1 && spec_.stairwells > 1);
    return bay;
  }

  double length_m() const { return spec_.rooms * kBay_m; }
  Outline plan() const { return rectangle({length_m() / 2, 0.0}, {length_m(), kCorridor_m + 2 * kRoomDepth_m}, 0.0); }

  // The two flights lie at the wall away from the corridor, the one going up first nearer to it.
  double flight_y(const Bay& bay, bool is_second) const {
    const double from_wall = leg_.width_m / 2 + 0.05 + (is_second ? 0.0 : leg_.width_m + kGap_m);
    return bay.side > 0 ? bay.high.y() - from_wall : bay.low.y() + from_wall;
  }

  // What a stairwell leaves open in the floor above it: everything beyond the first nosing.
  Outline well(const Bay& bay) const {
    const double x_low = bay.low.x() + kFoot_m - kShortestLanding_m;
    const double x_high = bay.low.x() + kFoot_m + leg_.run_m() + kHalfLanding_m;
    const double y1 = flight_y(bay, true) + bay.side * (leg_.width_m / 2 + 0.05);
    const double y2 = flight_y(bay, false) - bay.side * (leg_.width_m / 2 + 0.05);
    return rectangle_between({x_low, y1}, {x_high, y2});
  }

  std::vector<Outline> floor(bool has_wells) const {
    std::vector<Outline> pieces{plan()};
    if (!has_wells) return pieces;
    for (const Bay& bay : bays_) {
      if (bay.is_stairwell) cut(pieces, well(bay));
    }
    return pieces;
  }

  void add_slabs() {
    Mesh& mesh = building_.scene.mesh;
    for (int level = 0; level <= spec_.storeys; ++level) {
      const bool has_wells = level > 0 && level < spec_.storeys;
      const double z = level * leg_.storey_m();
      mesh.add_horizontal(floor(has_wells), z);
      if (level > 0) mesh.add_horizontal(floor(has_wells), z - kSlab_m);
      if (!has_wells) continue;
      for (const Bay& bay : bays_) {
        if (bay.is_stairwell) mesh.add_walls(well(bay), z - kSlab_m, z);
      }
    }
    mesh.add_walls(plan(), 0.0, spec_.storeys * leg_.storey_m());
  }

  double clear_m() const { return leg_.storey_m() - kSlab_m; }

  void add_wall(const Vector2d& low, const Vector2d& high, double z_low_m, double z_high_m) {
    const Vector2d size = high - low;
    building_.scene.mesh.add_box((low + high) / 2, z_low_m, {size.x(), size.y(), z_high_m - z_low_m}, 0.0);
  }

  static double door_x(const Bay& bay) {
    return bay.is_stairwell ? bay.low.x() + 0.1 + kStairwellDoor_m / 2 : bay.middle().x();
  }

  void add_walls(double z) {
    for (const Bay& bay : bays_) {
      const double y = bay.at_corridor_m();
      const double half = (bay.is_stairwell ? kStairwellDoor_m : kDoor_m) / 2;
      const double door = door_x(bay);
      const double thick = kWall_m / 2;
      add_wall({bay.low.x(), y - thick}, {door - half, y + thick}, z, z + clear_m());
      add_wall({door + half, y - thick}, {bay.high.x(), y + thick}, z, z + clear_m());
      add_wall({door - half, y - thick}, {door + half, y + thick}, z + kDoorHeight_m, z + clear_m());
      if (bay.high.x() + 1e-6 < length_m()) {
        add_wall({bay.high.x() - thick, bay.low.y()}, {bay.high.x() + thick, bay.high.y()}, z, z + clear_m());
      }
    }
  }

  void furnish_room(const Bay& bay, double z) {
    Room room;
    room.low = bay.low + Vector2d::Constant(kWall_m);
    room.high = bay.high - Vector2d::Constant(kWall_m);
    room.height_m = clear_m();
    const Outline door = rectangle({door_x(bay), bay.at_corridor_m()}, {kDoor_m, 2 * kDoor_m}, 0.0);
    for (Furniture& piece : furnish(room, clutter(), random_.integer(2, 7), {door}, random_)) {
      piece.level_m += z;
      building_.scene.mesh.append(build_furniture(piece));
    }
  }

  StairSpec flight(const Bay& bay, double z, bool is_second) const {
    StairSpec spec;
    spec.steps = leg_.steps;
    spec.height_m = leg_.height_m;
    spec.depth_m = leg_.depth_m;
    spec.width_m = leg_.width_m;
    spec.suspended = true;
    spec.landing_m = kShortestLanding_m;
    spec.level_m = is_second ? z + leg_.storey_m() / 2 : z;
    const double foot_x = bay.low.x() + kFoot_m;
    spec.position = {is_second ? foot_x + leg_.run_m() : foot_x, flight_y(bay, is_second)};
    spec.heading_rad = is_second ? std::numbers::pi : 0.0;
    const bool well_is_left = bay.side > 0;  // of both flights, for the second one goes back
    spec.railing_left = leg_.railing && well_is_left;
    spec.railing_right = leg_.railing && !well_is_left;
    return spec;
  }

  void add_dog_leg(const Bay& bay, double z) {
    for (const bool is_second : {false, true}) {
      const Flight built = build_flight(flight(bay, z, is_second));
      building_.scene.mesh.append(built.mesh);
      building_.scene.truths.push_back(built.truth);
    }
    const Outline open = well(bay);
    const double x_low = bay.low.x() + kFoot_m + leg_.run_m();
    const auto [y_low, y_high] = std::minmax({open[0].y(), open[2].y()});
    const double half_m = z + leg_.storey_m() / 2;
    // The first flight brings the beginning of the landing with it; the second one's part is added here.
    const double split = flight_y(bay, false) + bay.side * (leg_.width_m / 2);
    const double end = x_low + kShortestLanding_m;
    for (const Outline& slab : {rectangle_between({end, y_low}, {x_low + kHalfLanding_m, y_high}),
                                rectangle_between({x_low, split}, {end, bay.side > 0 ? y_high : y_low})}) {
      building_.scene.mesh.add_prism(slab, half_m - kLandingSlab_m, half_m);
    }
    stand({{bay.low.x() + 0.7, flight_y(bay, false), z}, 0.0});
    stand({{x_low + 0.75, (y_low + y_high) / 2, half_m}, std::numbers::pi});
  }

  Stand door_stand(const Bay& bay, double z) const { return {{door_x(bay), 0.0, z}, bay.side * std::numbers::pi / 2}; }

  void stand(const Stand& where) { building_.stands.push_back(where); }

  const BuildingSpec& spec_;
  Random random_;
  DogLeg leg_{};
  std::vector<Bay> bays_;
  Building building_;
};

}  // namespace

std::string BuildingSpec::problem() const {
  if (storeys < 1 || storeys > 20) return "storeys must lie between 1 and 20";
  if (rooms < 2 || rooms > 20) return "rooms must lie between 2 and 20";
  if (stairwells < 0 || stairwells > 2) return "stairwells must lie between 0 and 2";
  return {};
}

Building build_building(const BuildingSpec& spec) {
  if (const std::string problem = spec.problem(); !problem.empty()) throw std::invalid_argument{"building: " + problem};
  return Builder{spec}.build();
}

}  // namespace stairway::sim
