// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "detector/spot.hpp"
#include "detector/stair_corridor.hpp"
#include "detector/stair_model.hpp"

namespace stairway::detect {

/// A beam that met a flight, from the sensor, in the flight's axes.
struct StairBeam {
  double u = 0.0;  ///< of the point it measured, along the ascent [m]
  double v = 0.0;  ///< to the left [m]
  double z = 0.0;  ///< up [m]
  Backdrop backdrop;
  int first_step = 0;  ///< of the steps its spot may lie on
  int last_step = 0;   ///< likewise
};

/// The beams that tell something about a flight: those that ended on it or passed its edges, clear of its ends.
///
/// Beams next to what stands in the way, balusters say, are left out: it mixes into their echoes.
/// Which are taken does not depend on the order of the points.
/// @param frame  of the flight's lowest step; `sensor` in its axes.
/// @param faces  of the model from there, visible_faces().
/// @param sides  of the flight along v.
/// @param most_on_edges   beams whose spot lies near an edge; of more about so many are drawn, > 0.
/// @param most_on_planes  beams whose spot lies on one face, likewise.
/// Cost: O(n) in the points of the corridor.
std::vector<StairBeam> select_beams(const StairCorridor& corridor, const StepFrame& frame, const StepPoint& sensor,
                                    std::span<const VisibleFace> faces, const Interval& sides, double spot_radius_rad,
                                    int most_on_edges, int most_on_planes);

}  // namespace stairway::detect
