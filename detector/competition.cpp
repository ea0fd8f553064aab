// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "detector/competition.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>
#include <utility>

namespace stairway::detect {
namespace {

// The robot stands on z = 0: what starts below that is looked down upon.
View view_of(const StairModel& model) { return model.nosing.z() < 0.0 ? View::FromAbove : View::FromBelow; }

Interval starting_sides(const Initialisation& start, const std::vector<StairPart>& parts) {
  const Interval a = sides_of(parts[start.parts[0]], start.model.step(0));
  const Interval b = sides_of(parts[start.parts[1]], start.model.step(1));
  return {std::min(a.low, b.low), std::max(a.high, b.high)};
}

class Competition {
 public:
  Competition(const std::vector<StairPart>& parts, const CompetitionOptions& options)
      : parts_(parts),
        options_(options),
        grid_(parts, options.extension.search_radius_m),
        taken_(region_count(parts), false) {}

  CompetitionResult run() {
    const std::vector<Initialisation> starts = initialise_graphs(parts_, options_.initialisation);
    if (options_.strategy == Strategy::Greedy) {
      take_first(starts);
    } else {
      choose_best(starts);
    }
    if (!result_.winners.empty()) result_.runner_up.reset();
    std::stable_sort(result_.winners.begin(), result_.winners.end(),
                     [](const Winner& a, const Winner& b) { return a.score > b.score; });
    return std::move(result_);
  }

 private:
  // The planes of a stairway are off the list for those that follow.
  void take_first(const std::vector<Initialisation>& starts) {
    for (const Initialisation& start : starts) {
      std::optional<Winner> candidate = confirmed(start);
      if (!candidate) continue;
      claim(std::move(*candidate));
      grid_.remove_if([&](std::size_t part) { return is_taken(part); });
    }
  }

  void choose_best(const std::vector<Initialisation>& starts) {
    std::vector<Winner> candidates;
    for (const Initialisation& start : starts)
      if (std::optional<Winner> candidate = confirmed(start)) candidates.push_back(std::move(*candidate));
    std::stable_sort(candidates.begin(), candidates.end(),
                     [](const Winner& a, const Winner& b) { return a.score > b.score; });
    for (Winner& candidate : candidates) {
      if (!is_free(candidate.graph)) continue;
      if (options_.strategy != Strategy::Thorough) optimise(candidate);
      claim(std::move(candidate));
    }
  }

  std::optional<Winner> confirmed(const Initialisation& start) {
    if (is_taken(start.parts[0]) || is_taken(start.parts[1])) return std::nullopt;
    Winner candidate{.graph = {}, .view = view_of(start.model)};
    candidate.graph =
        extend_graph(start.model, starting_sides(start, parts_), parts_, grid_, candidate.view, options_.extension);
    if (const std::string rule = broken_rule(candidate.graph, confirmation()); !rule.empty()) {
      remember(rule, candidate.graph);
      return std::nullopt;
    }
    candidate.score = score(candidate.graph, parts_, candidate.view).total();
    return candidate;
  }

  // Two planes may be all that a descent or far boards show. The joint fit looks for the points of further steps, and
  // confirms.
  ConfirmationOptions confirmation() const {
    ConfirmationOptions confirmation = options_.confirmation;
    if (options_.strategy == Strategy::Joint) confirmation.min_steps = 2;
    return confirmation;
  }

  void optimise(Winner& winner) const {
    const StairFit fit = fit_stairway(winner.graph, parts_, winner.view);
    StairGraph extended = extend_graph(fit.model, winner.graph.sides, parts_, grid_, winner.view, options_.extension);
    if (!is_free(extended) || !broken_rule(extended, confirmation()).empty() ||
        extended.seen_steps() < winner.graph.seen_steps())
      return;
    winner.graph = std::move(extended);
    winner.sigmas = fit.sigmas;
    winner.score = score(winner.graph, parts_, winner.view).total();
  }

  // Two parts may stand for one region, so it is regions that are taken.
  bool is_taken(std::size_t part) const { return taken_[parts_[part].region]; }

  static std::size_t region_count(const std::vector<StairPart>& parts) {
    std::size_t count = 0;
    for (const StairPart& part : parts) count = std::max(count, part.region + 1);
    return count;
  }

  bool is_free(const StairGraph& graph) const {
    return std::none_of(graph.parts.begin(), graph.parts.end(),
                        [&](const GraphPart& entry) { return is_taken(entry.part); });
  }

  void claim(Winner winner) {
    for (const GraphPart& entry : winner.graph.parts) taken_[parts_[entry.part].region] = true;
    result_.winners.push_back(std::move(winner));
  }

  void remember(const std::string& rule, const StairGraph& graph) {
    const int steps = graph.seen_steps();
    if (steps <= most_steps_) return;
    most_steps_ = steps;
    result_.runner_up = rejection(rule, graph.model, steps, options_.confirmation);
  }

  const std::vector<StairPart>& parts_;
  const CompetitionOptions& options_;
  PartGrid grid_;
  std::vector<bool> taken_;
  CompetitionResult result_;
  int most_steps_ = 0;
};

}  // namespace

std::string CompetitionOptions::problem() const {
  for (const std::string& problem : {initialisation.problem(), extension.problem(), confirmation.problem()})
    if (!problem.empty()) return problem;
  return {};
}

namespace {

// What the rule is about and what the reader can do.
std::string advice(const std::string& rule) {
  static constexpr std::array<std::pair<std::string_view, std::string_view>, 7> kAdvice{{
      {"too-few-steps", ", too few: bring more of the flight into view"},
      {"slope-out-of-range", ", flatter or steeper than stairs: a ramp, a ladder, or a cloud that is not level"},
      {"step-size-out-of-range", " of a height or depth that stairs do not have: are lengths in metres?"},
      {"steps-missing", " with gaps between them: furniture, or a flight that something hides"},
      {"too-uncertain", ", too uncertain to climb: go nearer or bring more of them into view"},
      {"beams-disagree", " that single beams do not end on: other things in a row, or a cloud that leans"},
      {"no-points-on-steps", " only: planes lie like those of a flight, but its steps show no points"},
  }};
  for (const auto& [name, text] : kAdvice)
    if (name == rule) return std::string(text);
  return {};
}

}  // namespace

Rejection rejection(const std::string& rule, const StairModel& model, int seen_steps,
                    const ConfirmationOptions& confirmation) {
  return {.reason = rule,
          .detail = "the best candidate shows " + std::to_string(seen_steps) + " steps" + advice(rule),
          .figures = {{"steps", seen_steps},
                      {"min_steps", confirmation.min_steps},
                      {"step_height", model.height_m},
                      {"step_depth", model.depth_m},
                      {"pitch", std::atan2(model.height_m, model.depth_m)},
                      {"x", model.nosing.x()},
                      {"y", model.nosing.y()},
                      {"z", model.nosing.z()}}};
}

CompetitionResult compete(const std::vector<StairPart>& parts, const CompetitionOptions& options) {
  return Competition(parts, options).run();
}

}  // namespace stairway::detect
