// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <numbers>
#include <string>
#include <vector>

#include "detector/stair_model.hpp"
#include "detector/stair_part.hpp"

namespace stairway::detect {

struct InitialisationOptions {
  StepLimits limits;
  double max_pair_distance_m = 1.0;  ///< between the centroids of two parts of neighbouring steps, horizontally [m]
  double max_riser_angle_rad =
      std::numbers::pi / 12;         ///< between the normals of two risers of neighbouring steps [rad]
  double min_side_overlap_m = 0.10;  ///< of the two parts, across the stairway [m]
  bool spirals = true;               ///< also start spirals

  std::string problem() const;
};

/// A model to start a graph from, and the two parts it was read off.
struct Initialisation {
  StairModel model;                  ///< step 0 is the lower part's
  std::array<std::size_t, 2> parts;  ///< indices of the lower and the upper part
};

/// Every model that two risers or two treads of neighbouring steps suggest.
///
/// Two risers give up to two: h from their top or from their bottom edges. Two treads give up to four: d from their
/// front or back edges, s from the first or the second. Each pair may start spirals as well, see suggested_spirals().
///
/// @return initialisations within the limits, ordered by their parts. Cost: O(P k) for k parts around each of P.
/// Method: Westfechtel et al. 2018, section "Graph Initialization".
std::vector<Initialisation> initialise_graphs(const std::vector<StairPart>& parts,
                                              const InitialisationOptions& options = {});

}  // namespace stairway::detect
