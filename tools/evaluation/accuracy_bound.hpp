// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "scan_assembly/frames.hpp"
#include "tools/sim/scene.hpp"

namespace stairway::evaluation {

/// What the sensor is taken to know when its bound is asked for. The defaults are those of the simulated one, which
/// drops mixed pixels and knows nothing about edges beyond where its beams fall.
struct BoundOptions {
  double range_sigma_m = 0.010;  ///< white noise of a range [m], > 0
  double angle_sigma_rad = 0.0;  ///< of a beam's direction, in any plane [rad]
  double edge_sigma_rad = 0.0;   ///< of the place within the spot at which a beam leaves an edge [rad]
  double spot_rad = 13.3e-3;     ///< full angle; beams whose spot is not on one surface alone are dropped; 0 keeps all
  double disk_period_s = 35.0;   ///< of one revolution [s]
  int stride = 4;                ///< of the mirror turns that are cast; those between count as the one before them
};

/// One standard deviation of the best unbiased estimate.
struct AccuracyBound {
  double height_m = 0.0;
  double depth_m = 0.0;
  double heading_rad = 0.0;
  double width_m = 0.0;
  double along_m = 0.0;   ///< of the middle of the lowest nosing, in the direction of ascent
  double across_m = 0.0;  ///< likewise to the left
  double up_m = 0.0;      ///< likewise
};

/// Cramer-Rao bound for one straight, regular flight that a level sensor sees in one revolution: planes by the beams
/// that end on them, edges by neighbouring beams of one mirror turn that pass on either side (a uniform distribution
/// between them). How far treads are thick and stand out over risers is to be estimated, too.
///
/// @param flight  which of the scene's.
/// @return nothing for spirals and irregular flights, and where the beams leave a parameter open.
/// Cost: a ray per beam and four more per beam on the flight, over the stride.
std::optional<AccuracyBound> accuracy_bound(const sim::Scene& scene, const scan::MountOptions& mount,
                                            const BoundOptions& options = {}, std::size_t flight = 0);

}  // namespace stairway::evaluation
