// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <numbers>
#include <string>
#include <vector>

#include "detector/deviation.hpp"
#include "detector/graph_initialisation.hpp"
#include "detector/part_grid.hpp"
#include "detector/stair_model.hpp"
#include "detector/stair_part.hpp"

namespace stairway::detect {

/// A part in its place on a stairway.
struct GraphPart {
  int step = 0;          ///< number of the step it belongs to
  std::size_t part = 0;  ///< index into the list of parts
};

/// The stair graph of the paper: a model and the parts that comply with it.
struct StairGraph {
  StairModel model;
  std::vector<GraphPart> parts;  ///< by step; a part occurs once
  Interval sides;  ///< from the rightmost to the leftmost part end, along left() from the middle line of `model` [m]

  /// Number of steps that have at least one part.
  int seen_steps() const;
};

struct ExtensionOptions {
  double search_radius_m = 1.0;          ///< r of Alg. 4, around the predicted part, horizontally [m]
  int max_empty_steps = 2;               ///< a direction ends after this many steps without a part (the paper's two)
  int max_steps = 200;                   ///< no stairway is longer; bounds the work
  double max_depth_deviation_m = 0.05;   ///< a part complies up to this delta_d [m]
  double max_height_deviation_m = 0.05;  ///< and this delta_h [m]
  double max_direction_rad = std::numbers::pi / 9;  ///< and this delta_s [rad]
  double min_side_overlap_m = 0.10;                 ///< with what the graph spans already [m]

  std::string problem() const;
};

/// Grows a graph step by step from step 0 of `model`, first up, then down (Alg. 4, lines 6 to 17).
///
/// @param model  where to start; not refined on the way.
/// @param sides  what the starting parts span along left(), from the middle line of the model [m].
/// @return the graph; without parts when none complies.
StairGraph extend_graph(const StairModel& model, const Interval& sides, const std::vector<StairPart>& parts, View view,
                        const ExtensionOptions& options = {});
/// The same for many graphs over the same parts.
/// @param grid  of the parts.
StairGraph extend_graph(const StairModel& model, const Interval& sides, const std::vector<StairPart>& parts,
                        const PartGrid& grid, View view, const ExtensionOptions& options = {});

struct ConfirmationOptions {
  double min_slope_rad = std::numbers::pi / 9;       ///< 20 deg
  double max_slope_rad = std::numbers::pi * 5 / 18;  ///< 50 deg
  int min_steps = 3;                                 ///< steps of which some part was found

  std::string problem() const;
};

/// The rule that a stairway of this model breaks when parts of `seen_steps` steps were found.
std::string broken_rule(const StairModel& model, int seen_steps, const ConfirmationOptions& options);

/// The rule a graph breaks (section "Stairway Confirmation"), or an empty string when it is a stairway.
/// Rules: "slope-out-of-range", "too-few-steps".
std::string broken_rule(const StairGraph& graph, const ConfirmationOptions& options = {});

/// The two addends of eq 2 and what they are made of; every subscore is at most 1.
struct StairScore {
  double risers = 0.0;                                                          ///< S_r, eq 3
  double treads = 0.0;                                                          ///< S_t, eq 14
  int riser_count = 0;                                                          ///< n_r
  int tread_count = 0;                                                          ///< n_t
  double total() const { return risers * riser_count + treads * tread_count; }  ///< S, eq 2
};

/// Eqs 2 to 19, each mean taken over i = 1..n (the paper prints 0..n).
StairScore score(const StairGraph& graph, const std::vector<StairPart>& parts, View view);

}  // namespace stairway::detect
