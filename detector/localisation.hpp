// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "detector/competition.hpp"
#include "detector/stairway.hpp"

namespace stairway::detect {

struct LocalisationOptions {
  int max_hidden_steps = 6;  ///< a graph that begins above the ground is extended by at most this many unseen steps

  std::string problem() const;
};

/// Turns a graph into the stairway a robot can climb: first step on the ground, ends, anchor and every nosing.
///
/// A stairway that seems to begin above the ground (z = 0) is continued down to it; steps at or below it are dropped.
///
/// Method: Westfechtel et al. 2018, section "Localization Using a Dynamic Anchor".
Stairway localise(const Winner& winner, const std::vector<StairPart>& parts, const LocalisationOptions& options = {});

}  // namespace stairway::detect
