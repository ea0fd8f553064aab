// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "detector/stair_graph.hpp"

namespace stairway::detect {

/// One standard deviation of each parameter, from the scatter of the parts about the fitted model.
struct FitSigmas {
  double height_m = 0.0;
  double depth_m = 0.0;
  double heading_rad = 0.0;
};

struct StairFit {
  StairModel model;
  FitSigmas sigmas;
};

/// Moves the model so that its parts fit best: Levenberg-Marquardt on the costs of eq 20 over h, d, the direction of s,
/// the place of P along s and z and, of a spiral, delta phi. Where P lies across the stairway does not enter the costs
/// and stays.
///
/// Metres and radians are added with weight 1, as printed.
///
/// @return the fitted model; the given one when the graph has too few parts to fix the parameters or the fit does not
///         converge to finite values.
/// Method: Westfechtel et al. 2018, section "Competing Initialization Strategies", eq 20.
StairFit fit_stairway(const StairGraph& graph, const std::vector<StairPart>& parts, View view);

}  // namespace stairway::detect
