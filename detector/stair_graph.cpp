// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "detector/stair_graph.hpp"

#include <algorithm>
#include <cmath>

namespace stairway::detect {
namespace {

bool complies(const StairModel& model, int number, const StairPart& part, View view, const ExtensionOptions& options) {
  const Deviation off = deviation(model, number, part, view);
  return off.depth_m <= options.max_depth_deviation_m && off.height_m <= options.max_height_deviation_m &&
         off.direction_rad <= options.max_direction_rad;
}

class Extension {
 public:
  Extension(StairGraph& graph, const std::vector<StairPart>& parts, const PartGrid& grid, View view,
            const ExtensionOptions& options)
      : graph_(graph), parts_(parts), grid_(grid), view_(view), options_(options), taken_(parts.size(), false) {}

  bool visit(int number) {
    const StepFrame step = graph_.model.step(number);
    bool found = false;
    grid_.around(step.nosing.head<2>(), options_.search_radius_m, near_);
    for (const std::size_t i : near_) {
      const StairPart& part = parts_[i];
      if (taken_[i] || (part.centroid - step.nosing).head<2>().squaredNorm() > square(options_.search_radius_m) ||
          !complies(graph_.model, number, part, view_, options_))
        continue;
      if (overlap(sides_of(part, step), graph_.sides) < options_.min_side_overlap_m) continue;
      taken_[i] = true;
      found = true;
      graph_.parts.push_back({number, i});
    }
    return found;
  }

  void go(int direction) {
    int empty_steps = 0;
    for (int number = direction; std::abs(number) <= options_.max_steps; number += direction) {
      empty_steps = visit(number) ? 0 : empty_steps + 1;
      if (empty_steps >= options_.max_empty_steps) return;
    }
  }

 private:
  static double square(double value) { return value * value; }

  StairGraph& graph_;
  const std::vector<StairPart>& parts_;
  const PartGrid& grid_;
  View view_;
  const ExtensionOptions& options_;
  std::vector<std::size_t> near_;
  std::vector<bool> taken_;
};

}  // namespace

int StairGraph::seen_steps() const {
  int count = 0;
  for (std::size_t i = 0; i < parts.size(); ++i)
    if (i == 0 || parts[i].step != parts[i - 1].step) ++count;
  return count;
}

std::string ExtensionOptions::problem() const {
  if (!(search_radius_m > 0.0)) return "search_radius_m must be greater than 0";
  if (max_empty_steps < 1) return "max_empty_steps must be at least 1";
  if (max_steps < 3) return "max_steps must be at least 3";
  if (!(max_depth_deviation_m > 0.0 && max_height_deviation_m > 0.0 && max_direction_rad > 0.0))
    return "the largest deviations must be greater than 0";
  return {};
}

StairGraph extend_graph(const StairModel& model, const Interval& sides, const std::vector<StairPart>& parts, View view,
                        const ExtensionOptions& options) {
  return extend_graph(model, sides, parts, PartGrid(parts, options.search_radius_m), view, options);
}

StairGraph extend_graph(const StairModel& model, const Interval& sides, const std::vector<StairPart>& parts,
                        const PartGrid& grid, View view, const ExtensionOptions& options) {
  StairGraph graph{.model = model, .parts = {}, .sides = sides};
  Extension extension(graph, parts, grid, view, options);
  extension.visit(0);
  extension.go(+1);
  extension.go(-1);
  std::stable_sort(graph.parts.begin(), graph.parts.end(),
                   [](const GraphPart& a, const GraphPart& b) { return a.step < b.step; });
  return graph;
}

std::string ConfirmationOptions::problem() const {
  if (!(0.0 < min_slope_rad && min_slope_rad < max_slope_rad)) return "slopes must satisfy 0 < minimum < maximum";
  if (min_steps < 2) return "min_steps must be at least 2";
  return {};
}

std::string broken_rule(const StairModel& model, int seen_steps, const ConfirmationOptions& options) {
  const double slope = std::atan2(model.height_m, model.depth_m);
  if (seen_steps < options.min_steps) return "too-few-steps";
  if (slope < options.min_slope_rad || slope > options.max_slope_rad) return "slope-out-of-range";
  return {};
}

std::string broken_rule(const StairGraph& graph, const ConfirmationOptions& options) {
  return broken_rule(graph.model, graph.seen_steps(), options);
}

StairScore score(const StairGraph& graph, const std::vector<StairPart>& parts, View view) {
  const StairModel& model = graph.model;
  StairScore result;
  for (const GraphPart& entry : graph.parts) {
    const StairPart& part = parts[entry.part];
    const Deviation off = deviation(model, entry.step, part, view);
    const double depth_score = (model.depth_m - off.depth_m) / model.depth_m;      // eqs 4, 15
    const double height_score = (model.height_m - off.height_m) / model.height_m;  // eqs 7, 18
    if (part.kind != StairPart::Kind::Tread) {  // an edge counts as what is left of a riser
      result.risers += depth_score + height_score + (1.0 - off.direction_rad);  // eqs 3, 12
      ++result.riser_count;
    } else {
      result.treads += depth_score + height_score;  // eq 14
      ++result.tread_count;
    }
  }
  if (result.riser_count > 0) result.risers /= result.riser_count;
  if (result.tread_count > 0) result.treads /= result.tread_count;
  return result;
}

}  // namespace stairway::detect
