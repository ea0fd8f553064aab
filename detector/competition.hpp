// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "detector/stair_fit.hpp"
#include "detector/stair_graph.hpp"
#include "detector/stairway.hpp"

namespace stairway::detect {

/// How initialisations that claim the same parts compete (section "Competing Initialization Strategies").
enum class Strategy {
  Greedy,      ///< the first confirmed graph keeps its parts
  Thorough,    ///< all are extended and scored; the best keeps its parts
  Optimizing,  ///< thorough, then the winner is fitted (eq 20) and extended once more
  Joint,       ///< optimizing, then the winner is fitted to the points of all its steps (ours, see joint_fit.hpp)
};

struct CompetitionOptions {
  Strategy strategy = Strategy::Joint;
  InitialisationOptions initialisation;
  ExtensionOptions extension;
  ConfirmationOptions confirmation;

  std::string problem() const;
};

/// Words a candidate that broke a rule for the answer.
Rejection rejection(const std::string& rule, const StairModel& model, int seen_steps,
                    const ConfirmationOptions& confirmation);

/// A graph that won its parts.
struct Winner {
  StairGraph graph;
  View view = View::FromBelow;
  FitSigmas sigmas;    ///< zero unless the strategy fits
  double score = 0.0;  ///< eq 2
};

struct CompetitionResult {
  std::vector<Winner> winners;         ///< best score first; no part belongs to two of them
  std::optional<Rejection> runner_up;  ///< the graph with most steps that was not confirmed, when nothing won
};

/// Initialises, extends, confirms and lets the graphs compete for their parts.
/// Cost: O(I S k) for I initialisations, S steps and k parts around each.
CompetitionResult compete(const std::vector<StairPart>& parts, const CompetitionOptions& options = {});

}  // namespace stairway::detect
