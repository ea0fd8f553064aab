// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "tools/sim/merged_sweeps.hpp"
#include "tools/sim/scene.hpp"

namespace stairway::sim {

/// A building as an office might be: on every storey a corridor along x with a row of rooms on either side. The first
/// room of one row and, with `stairwells` = 2, the last of the other are stairwells with dog-leg stairs: a flight up to
/// a half landing and one back to the next storey.
struct BuildingSpec {
  int storeys = 3;     ///< 1 to 20
  int rooms = 4;       ///< in each of the two rows, 2 to 20
  int stairwells = 2;  ///< 0 to 2
  std::uint64_t seed = 1;

  /// First problem found; empty when it can be built.
  std::string problem() const;
};

/// The frame of a building has its origin on the lowest floor in the corridor, at its end.
struct Building {
  /// Truths: every flight, storey by storey, ascending from the floor or half landing that it stands on. Steps, widths,
  /// railings and furniture are drawn from the seed.
  Scene scene;
  /// Where a robot would stop to see everything: in the corridor before each room and at the foot of every flight, in
  /// the order in which it would come by.
  std::vector<Stand> stands;
};

/// Throws std::invalid_argument with problem(). The same seed gives the same building on every machine.
Building build_building(const BuildingSpec& spec);

}  // namespace stairway::sim
