// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "tools/sim/random_flight.hpp"

#include <cmath>

#include "tools/sim/angles.hpp"
#include "tools/sim/random_layout.hpp"

namespace stairway::sim {

void draw_usual_steps(StairSpec& flight, Random& random) {
  do {
    flight.height_m = random.uniform(0.14, 0.20);
    flight.depth_m = random.uniform(0.24, 0.34);
  } while (std::abs(2 * flight.height_m + flight.depth_m - 0.64) > 0.06);
}

void draw_fittings(StairSpec& flight, Random& random) {
  flight.tread_thickness_m = random.uniform(0.03, 0.06);
  flight.overhang_m = random.chance(0.5) ? random.uniform(0.0, 0.03) : 0.0;
  flight.railing_left = random.chance(0.35);
  flight.railing_right = random.chance(0.35);
  flight.landing_m = random.uniform(0.8, 1.6);
}

void place_before_robot(StairSpec& flight, double nearest_m, double farthest_m, Random& random) {
  constexpr double kMaxSkew_rad = 40 * kDegree;
  do {
    const double distance = random.uniform(nearest_m, farthest_m);
    const double skew = random.uniform(-kMaxSkew_rad, kMaxSkew_rad);
    flight.heading_rad = random_yaw(random);
    flight.position = distance * unit(flight.heading_rad - skew);
  } while (overlap(build_flight(flight).footprint, robot_space()));
}

}  // namespace stairway::sim
