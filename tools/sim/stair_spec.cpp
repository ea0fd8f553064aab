// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "tools/sim/stair_spec.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <utility>

namespace stairway::sim {
namespace {

constexpr double kRailingHeight_m = 0.9;
constexpr double kRailingInset_m = 0.04;
constexpr double kBalusterRadius_m = 0.012;
constexpr double kHandrailThickness_m = 0.045;
constexpr double kLandingThickness_m = 0.16;
constexpr double kFloorStrip_m = 0.05;  // of the floor one stands on, above a descending flight
constexpr double kSpiralEye_m = 0.08;   // least inner radius of a spiral
const Eigen::Vector2d kAhead = Eigen::Vector2d::UnitX();

// Where a nosing lies: its middle, height, and the direction of ascent there.
struct Place {
  Eigen::Vector2d middle;
  double z_m;
  double heading_rad;

  Eigen::Vector2d ahead() const { return Eigen::Rotation2Dd{heading_rad} * kAhead; }
  Eigen::Vector2d leftward() const { return Eigen::Rotation2Dd{heading_rad} * Eigen::Vector2d::UnitY(); }
};

// One side of the flight or the other, seen while ascending.
struct Ends {
  Eigen::Vector2d left, right;
};

double mid_radius_m(const StairSpec& spec) { return spec.depth_m / (2 * std::sin(spec.turn_per_step_rad / 2)); }

double offset(const std::vector<double>& offsets, int i) {
  return offsets.empty() ? 0.0 : offsets[static_cast<std::size_t>(i)];
}

// Nosing i (from 0) of a flight that starts at the origin and ascends along x.
Place place_from_start(const StairSpec& spec, int i) {
  Place place{{i * spec.depth_m, 0.0}, 0.0, i * spec.turn_per_step_rad};
  if (spec.turn_per_step_rad != 0) {
    const double radius = mid_radius_m(spec);
    place.middle = radius * Eigen::Vector2d{std::sin(place.heading_rad), 1 - std::cos(place.heading_rad)};
  }
  return place;
}

double lower_floor_m(const StairSpec& spec) {
  return spec.level_m - (spec.descending ? spec.steps * spec.height_m : 0.0);
}

std::vector<Place> place_nosings(const StairSpec& spec) {
  const Place meeting = place_from_start(spec, spec.descending ? spec.steps - 1 : 0);
  const double turn = spec.heading_rad - meeting.heading_rad;
  const double low = lower_floor_m(spec);
  std::vector<Place> places;
  for (int i = 0; i < spec.steps; ++i) {
    Place place = place_from_start(spec, i);
    place.middle = spec.position + Eigen::Rotation2Dd{turn} * (place.middle - meeting.middle);
    place.heading_rad += turn;
    place.middle += offset(spec.depth_offsets_m, i) * place.ahead();
    place.z_m = low + (i + 1) * spec.height_m + offset(spec.height_offsets_m, i);
    places.push_back(place);
  }
  return places;
}

Ends ends(const Place& place, double width_m, double beyond_m = 0.0) {
  const Eigen::Vector2d middle = place.middle + beyond_m * place.ahead();
  const Eigen::Vector2d half = width_m / 2 * place.leftward();
  return {middle + half, middle - half};
}

Outline between(const Ends& front, const Ends& back) { return {front.right, back.right, back.left, front.left}; }

double upper_landing_m(const StairSpec& spec) {
  return spec.descending ? kFloorStrip_m + spec.overhang_m : spec.landing_m;
}

// The front and back of tread i as seen from above; the last one is the landing.
Outline tread_outline(const StairSpec& spec, const std::vector<Place>& places, std::size_t i, double front_m) {
  const Ends front = ends(places[i], spec.width_m, front_m);
  if (i + 1 < places.size()) return between(front, ends(places[i + 1], spec.width_m, spec.overhang_m));
  return between(front, ends(places[i], spec.width_m, upper_landing_m(spec)));
}

void add_closed_steps(const StairSpec& spec, const std::vector<Place>& places, double low_m, Mesh& mesh) {
  constexpr double kSoffit_m = 0.15;
  const bool is_solid = spec.turn_per_step_rad == 0 && !spec.suspended;  // a solid spiral would hide itself
  for (std::size_t i = 0; i < places.size(); ++i) {
    const double foot_m = is_solid ? low_m : std::max(low_m, places[i].z_m - spec.height_m - kSoffit_m);
    if (!is_solid) mesh.add_horizontal(tread_outline(spec, places, i, 0.0), foot_m);
    if (spec.overhang_m > 0) {
      mesh.add_prism(tread_outline(spec, places, i, 0.0), places[i].z_m - spec.tread_thickness_m, places[i].z_m);
      mesh.add_walls(tread_outline(spec, places, i, spec.overhang_m), foot_m, places[i].z_m - spec.tread_thickness_m);
    } else {
      mesh.add_walls(tread_outline(spec, places, i, 0.0), foot_m, places[i].z_m);
      mesh.add_horizontal(tread_outline(spec, places, i, 0.0), places[i].z_m);
    }
  }
}

void add_boards(const StairSpec& spec, const std::vector<Place>& places, Mesh& mesh) {
  for (std::size_t i = 0; i < places.size(); ++i) {
    const double thickness = i + 1 < places.size() ? spec.tread_thickness_m : kLandingThickness_m;
    mesh.add_prism(tread_outline(spec, places, i, 0.0), places[i].z_m - thickness, places[i].z_m);
  }
}

Eigen::Vector3d at_height(const Eigen::Vector2d& p, double z_m) { return {p.x(), p.y(), z_m}; }

void add_stringers(const StairSpec& spec, const std::vector<Place>& places, Mesh& mesh) {
  constexpr double kWidth_m = 0.05;
  constexpr double kHeight_m = 0.16;
  if (spec.turn_per_step_rad != 0 || places.size() < 2) return;
  const double below = spec.tread_thickness_m + kHeight_m;
  for (const double side : {-1.0, 1.0}) {
    const auto point = [&](const Place& place) {
      const Eigen::Vector2d p =
          place.middle + spec.depth_m / 2 * place.ahead() + side * 0.3 * spec.width_m * place.leftward();
      return at_height(p, place.z_m - below);
    };
    mesh.add_beam(point(places.front()), point(places[places.size() - 2]), kWidth_m, kHeight_m);
  }
}

void add_railing(const StairSpec& spec, const std::vector<Place>& places, double side, Mesh& mesh) {
  const auto foot = [&](const Place& place, double beyond_m) -> Eigen::Vector2d {
    return place.middle + beyond_m * place.ahead() + side * (spec.width_m / 2 - kRailingInset_m) * place.leftward();
  };
  const double beyond = (spec.descending ? spec.depth_m : std::min(spec.depth_m, spec.landing_m)) / 2;
  for (std::size_t i = 0; i < places.size(); ++i) {
    mesh.add_post(foot(places[i], beyond), places[i].z_m, places[i].z_m + kRailingHeight_m, kBalusterRadius_m, 6);
    if (i == 0) continue;
    mesh.add_beam(at_height(foot(places[i - 1], beyond), places[i - 1].z_m + kRailingHeight_m),
                  at_height(foot(places[i], beyond), places[i].z_m + kRailingHeight_m), kHandrailThickness_m,
                  kHandrailThickness_m);
  }
}

void add_spiral_column(const StairSpec& spec, const std::vector<Place>& places, double low_m, Mesh& mesh) {
  if (spec.turn_per_step_rad == 0) return;
  const double radius = mid_radius_m(spec);
  const Eigen::Vector2d center = places.front().middle + radius * places.front().leftward();
  const double inner = std::abs(radius) - spec.width_m / 2;
  mesh.add_post(center, low_m, places.back().z_m + kRailingHeight_m, std::min(inner - 0.02, 0.15), 12);
}

detect::Stairway make_truth(const StairSpec& spec, const std::vector<Place>& places) {
  detect::Stairway truth;
  truth.kind = spec.turn_per_step_rad == 0 ? detect::StairwayKind::Straight : detect::StairwayKind::Spiral;
  truth.direction = spec.descending ? detect::StairwayDirection::Descending : detect::StairwayDirection::Ascending;
  truth.step_height = spec.height_m;
  truth.step_depth = spec.depth_m;
  truth.width = spec.width_m;
  truth.heading = -std::remainder(-places.front().heading_rad, 2 * std::numbers::pi);
  truth.turn_per_step = spec.turn_per_step_rad;
  truth.railing_left = spec.railing_left;
  truth.railing_right = spec.railing_right;
  for (const auto& place : places) {
    const Ends both = ends(place, spec.width_m);
    truth.nosings.push_back({at_height(both.left, place.z_m), at_height(both.right, place.z_m)});
  }
  if (spec.railing_left != spec.railing_right)
    truth.anchor_side = spec.railing_left ? detect::AnchorSide::Left : detect::AnchorSide::Right;
  truth.anchor = truth.met_nosing().at(truth.anchor_side);
  return truth;
}

Outline make_footprint(const StairSpec& spec, const std::vector<Place>& places) {
  std::vector<Eigen::Vector2d> points;
  const auto add = [&](const Ends& both) { points.insert(points.end(), {both.left, both.right}); };
  if (spec.descending) add(ends(places.front(), spec.width_m, -spec.landing_m));
  for (const auto& place : places) add(ends(place, spec.width_m));
  add(ends(places.back(), spec.width_m, upper_landing_m(spec)));
  return convex_hull(points);
}

std::string problem_of_offsets(const StairSpec& spec) {
  for (const auto* offsets : {&spec.height_offsets_m, &spec.depth_offsets_m}) {
    if (!offsets->empty() && offsets->size() != static_cast<std::size_t>(spec.steps)) {
      return fmt::format("offsets need one number per step: {} given for {} steps", offsets->size(), spec.steps);
    }
  }
  for (int i = 0; i < spec.steps; ++i) {
    const auto before = [&](const std::vector<double>& offsets) { return i > 0 ? offset(offsets, i - 1) : 0.0; };
    if (spec.height_m + offset(spec.height_offsets_m, i) - before(spec.height_offsets_m) < 0.01) {
      return fmt::format("height offsets leave step {} without height", i + 1);
    }
    if (spec.depth_m + offset(spec.depth_offsets_m, i) - before(spec.depth_offsets_m) < 0.02 + spec.overhang_m) {
      return fmt::format("depth offsets leave step {} without depth", i + 1);
    }
  }
  return {};
}

}  // namespace

std::string StairSpec::problem() const {
  const auto range = [](const char* name, double value, double low, double high) {
    // Written so that NaN is outside.
    return value >= low && value <= high ? std::string{}
                                         : fmt::format("{} = {} is not within {} .. {}", name, value, low, high);
  };
  const std::pair<const char*, std::array<double, 3>> limits[] = {
      {"steps", {static_cast<double>(steps), 1, 200}},
      {"height_m", {height_m, 0.02, 1.0}},
      {"depth_m", {depth_m, 0.05, 3.0}},
      {"width_m", {width_m, 0.1, 20.0}},
      {"tread_thickness_m", {tread_thickness_m, 0.005, height_m}},
      {"overhang_m", {overhang_m, 0.0, depth_m / 2}},
      {"landing_m", {landing_m, 0.1, 20.0}},
      {"level_m", {level_m, -100.0, 100.0}},
      {"x", {position.x(), -150.0, 150.0}},
      {"y", {position.y(), -150.0, 150.0}},
      {"heading_rad", {heading_rad, -10.0, 10.0}},
      {"turn_per_step_rad", {turn_per_step_rad, -1.0, 1.0}},
  };
  for (const auto& [name, limit] : limits) {
    if (auto text = range(name, limit[0], limit[1], limit[2]); !text.empty()) return text;
  }
  if (turn_per_step_rad != 0 && std::abs(mid_radius_m(*this)) < width_m / 2 + kSpiralEye_m) {
    return fmt::format(
        "a spiral with depth {} m and turn {:.3f} rad per step has a mid radius of {:.3f} m, too small for its width "
        "{} m",
        depth_m, turn_per_step_rad, std::abs(mid_radius_m(*this)), width_m);
  }
  return problem_of_offsets(*this);
}

Flight build_flight(const StairSpec& spec) {
  if (const std::string problem = spec.problem(); !problem.empty()) throw std::invalid_argument{"stairs: " + problem};
  const std::vector<Place> places = place_nosings(spec);
  Flight flight;
  flight.low_m = lower_floor_m(spec);
  flight.high_m = places.back().z_m;
  if (spec.open_risers) {
    add_boards(spec, places, flight.mesh);
    add_stringers(spec, places, flight.mesh);
  } else {
    add_closed_steps(spec, places, flight.low_m, flight.mesh);
  }
  add_spiral_column(spec, places, flight.low_m, flight.mesh);
  if (spec.railing_left) add_railing(spec, places, 1.0, flight.mesh);
  if (spec.railing_right) add_railing(spec, places, -1.0, flight.mesh);
  flight.mesh.share_coplanar_surfaces();
  flight.truth = make_truth(spec, places);
  flight.footprint = make_footprint(spec, places);
  return flight;
}

Mesh flight_model(StairSpec spec) {
  spec.position.setZero();
  spec.heading_rad = spec.level_m = 0.0;
  spec.descending = false;
  return build_flight(spec).mesh;
}

}  // namespace stairway::sim
