// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "detector/competition.hpp"
#include "detector/railing.hpp"
#include "detector/stairway.hpp"
#include "detector/step_offsets.hpp"

namespace stairway::detect {

struct LocalisationOptions {
  int max_hidden_steps = 6;  ///< a graph that begins above the ground is extended by at most this many unseen steps

  std::string problem() const;
};

/// A stairway found and fitted, before it is placed in the building.
struct FittedStairway {
  StairModel model;
  Interval sides;              ///< along left(), from the middle line of the model [m]
  double sides_sigma_m = 0.0;  ///< of its length
  FitSigmas sigmas;
  std::vector<StepOffset> offsets;  ///< of its steps from the model; empty when none were measured
  int first = 0;                    ///< number of the lowest step seen
  int last = 0;                     ///< and of the highest
  bool on_landing = false;          ///< begins on a floor that was seen, so it is not continued to the ground
  double floor_m = 0.0;             ///< level of the floor it is continued to
  View view = View::FromBelow;
  double score = 0.0;  ///< eq 2
  int evidence = 0;    ///< parts, or measurements of steps, that bear it out
  Railing railing;
};

/// What the parts of a graph say about the stairway's ends.
FittedStairway from_parts(const Winner& winner, const std::vector<StairPart>& parts);

/// Drops every stairway of which more than half the steps lie within one with more evidence: it is the same one, found
/// from other parts. Of two that lie over each other the upper one stays: the lower is the underside of its steps.
/// The result is ordered by falling evidence.
std::vector<FittedStairway> without_duplicates(std::vector<FittedStairway> stairways);

/// An ascending stairway that, continued down to the ground, would pass under the upper end of another one or under the
/// landing there (taken to be as deep as that one is wide, and to reach as far to both sides) begins on that landing.
/// Cost: square in the number of stairways.
void begin_on_landings(std::vector<FittedStairway>& stairways);

/// Turns a fit into the stairway a robot can climb: first step on the ground, ends, anchor and every nosing.
///
/// An ascending stairway that seems to begin above its floor is continued down to it; steps at or below it are dropped.
/// A descending one is continued up to it: its last nosing is the edge of the floor the robot stands on.
///
/// The anchor is the end of the nosing where the one railing is seen, for what is seen is not hidden; its middle when
/// railings are seen on both sides or on none.
///
/// Method: Westfechtel et al. 2018, section "Localization Using a Dynamic Anchor".
Stairway localise(const FittedStairway& fitted, const LocalisationOptions& options = {});

}  // namespace stairway::detect
