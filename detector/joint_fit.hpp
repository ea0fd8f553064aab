// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "detector/beam_fit.hpp"
#include "detector/stair_fit.hpp"
#include "detector/step_measurement.hpp"
#include "detector/step_offsets.hpp"
#include "scan_assembly/point_cloud.hpp"

namespace stairway::detect {

struct JointFitOptions {
  StepMeasurementOptions measurement;
  BeamFitOptions beams;
  int passes = 6;            ///< at most, of measuring all steps and fitting the model to them
  int max_unseen_steps = 2;  ///< the stairway ends after this many steps in a row of which no point is found

  double max_sigma_m = 0.005;  ///< of step height and depth; what is less certain than this is no stairway to climb [m]
  double min_seen_share = 0.6;  ///< of the steps from the first to the last seen, so many must show points

  std::string problem() const;
};

/// A stairway fitted to the points of all its steps at once.
struct JointFit {
  StairModel model;
  FitSigmas sigmas;
  FitSigmas even_sigmas;       ///< what they were if steps were even: how well beams tell the model
  Interval sides;              ///< along left() from the middle line of the model, which is its middle [m]
  double sides_sigma_m = 0.0;  ///< of its length
  /// Where the first free lines of sight pass beyond the ends, whatever hides the ends themselves.
  std::optional<double> right_limit;
  std::optional<double> left_limit;  ///< likewise
  int first = 0;                     ///< number of the lowest step of which points were found
  int last = 0;                      ///< and of the highest
  bool on_landing = false;           ///< it begins on a floor of its own, which was seen below its lowest step
  /// Faces and edges of steps were measured, yet most single beams do not end on such a flight.
  bool is_contradicted = false;
  int seen_steps = 0;               ///< how many of them have points
  std::vector<StepOffset> offsets;  ///< of the seen steps from the model
  int measurements = 0;             ///< fronts, treads and undersides measured on them
};

/// Fits one model to the points of a stairway: fronts fix d, s and delta phi, treads and the edges of sight fix h. A
/// straight flight stays straight.
///
/// Starts from a graph's model, measures every step, fits, and measures again, looking for further steps at both ends.
/// The points are those of the cloud before thinning.
///
/// @param sides  what the graph's parts span along left() from the middle line of its model [m].
/// @return the fit; nothing when fewer than two steps show points, or when the graph has no parts or no width.
/// Cost: passes x steps x points of the stairway.
std::optional<JointFit> fit_jointly(const scan::PointCloud& cloud, const StairGraph& graph, const Interval& sides,
                                    View view, const JointFitOptions& options = {});

/// The rule a joint fit breaks, or an empty string when the points bear the stairway out.
/// Rules: those of broken_rule() for graphs, "step-size-out-of-range", "steps-missing", "too-uncertain",
/// "beams-disagree".
std::string broken_rule(const JointFit& fit, const StepLimits& limits, const ConfirmationOptions& confirmation,
                        const JointFitOptions& options);

}  // namespace stairway::detect
