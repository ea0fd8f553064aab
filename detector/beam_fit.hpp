// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "detector/stair_beams.hpp"
#include "detector/stair_fit.hpp"
#include "detector/step_offsets.hpp"

namespace stairway::detect {

struct BeamFitOptions {
  double pulse_separation_m = 0.7;  ///< surfaces nearer to each other in range give one echo between them [m]
  int edge_beams = 3000;            ///< whose spot lies near an edge; of more, about so many are drawn
  int plane_beams = 1500;           ///< and whose spot lies on one face, likewise
  double max_misfit = 2.0;          ///< root of chi^2 per beam, above which the beams do not see what the model says
  double min_explained = 0.2;       ///< share of the beams that must have measured what the model says

  std::string problem() const;
};

/// What is known before of a flight that is to be fitted.
struct BeamFitStart {
  StairModel model;                 ///< straight
  Interval sides;                   ///< along left() from the middle line of the model [m]
  int first = 0;                    ///< lowest step that was seen
  int last = 0;                     ///< and highest
  std::vector<StepOffset> offsets;  ///< of single steps from the model; none of a regular flight
  double range_sigma_m = 0.010;     ///< white noise of one range [m], > 0
  double spot_rad = 13.3e-3;        ///< about the full angle of the spot
  bool from_above = false;          ///< the sensor stands above the highest tread, which goes on as a floor
};

struct BeamFit {
  StairModel model;
  FitSigmas sigmas;
  FitSigmas even_sigmas;            ///< what they were if steps were even: how well beams tell the model
  std::vector<StepOffset> offsets;  ///< of every step from the model
  double spot_rad = 0.0;            ///< full angle of the spot that explains the mixed pixels best
  double misfit = 1.0;              ///< root of chi^2 per beam
  double explained = 0.0;           ///< share of the beams that measured what the model says
  StairProfileShape shape;          ///< that it shows, in the axes of its lowest step
};

/// Fits a straight flight to single beams: each measures the mean range of what its spot lies on, mixed pixels
/// included.
///
/// A maximum-likelihood estimate with a robust kernel: the expected range of every beam follows from the profile that
/// the model shows to the sensor and the share of the spot on each of its faces. Unknown are the place, heading, height
/// and depth of the steps, overhang and thickness, and the size of the spot.
/// @pre the start is within about half a spot of the truth and the corridor knows where the sensor stood.
/// @return nothing when too few beams see the flight or when they do not see what the model says.
/// Cost: about 100 passes over the beams.
std::optional<BeamFit> fit_beams(const StairCorridor& corridor, const BeamFitStart& start,
                                 const BeamFitOptions& options);

}  // namespace stairway::detect
