// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "detector/stairway_detector.hpp"

#include <algorithm>
#include <utility>

#include "detector/cloud_faults.hpp"
#include "detector/level_strips.hpp"
#include "detector/levelling.hpp"
#include "detector/voxel_grid.hpp"

namespace stairway::detect {
namespace {

std::vector<StairPart> find_parts(const scan::PointCloud& cloud, const std::vector<PlaneRegion>& regions,
                                  const PlaneFinderOptions& options) {
  std::vector<StairPart> parts;
  for (std::size_t i = 0; i < regions.size(); ++i) {
    for (std::optional<StairPart> part :
         {find_stair_part(cloud, regions[i], options), find_edge(cloud, regions[i], options)}) {
      if (!part) continue;
      part->region = i;
      parts.push_back(*part);
    }
  }
  if (options.find_edges)
    for (const StairPart& strip : find_level_strips(cloud, regions, options)) parts.push_back(strip);
  return parts;
}

// What is wrong with the whole cloud explains more than how its best candidate failed, and that more than that there
// was none.
void explain_silence(std::optional<Rejection> fault, std::size_t regions, const std::vector<StairPart>& parts,
                     std::vector<Rejection>& rejected) {
  if (fault) rejected.insert(rejected.begin(), std::move(*fault));
  if (!rejected.empty()) return;
  const auto treads = static_cast<double>(std::count_if(
      parts.begin(), parts.end(), [](const StairPart& part) { return part.kind == StairPart::Kind::Tread; }));
  rejected.push_back({.reason = "no-step-pair",
                      .detail = "no two risers or treads lie to each other as those of neighbouring steps do: are "
                                "stairs in view, z upwards and lengths in metres?",
                      .figures = {{"planes", static_cast<double>(regions)},
                                  {"risers", static_cast<double>(parts.size()) - treads},
                                  {"treads", treads}}});
}

FittedStairway as_fitted(const JointFit& fit, const Winner& winner) {
  return {.model = fit.model,
          .sides = fit.sides,
          .sides_sigma_m = fit.sides_sigma_m,
          .sigmas = fit.sigmas,
          .offsets = fit.offsets,
          .first = fit.first,
          .last = fit.last,
          .on_landing = fit.on_landing,
          .view = winner.view,
          .score = winner.score,
          .evidence = fit.measurements};
}

// Balusters hide the ends of the steps behind them, which lie between the last point seen and the first line of sight
// that passes freely beyond; posts stand close to the ends.
Interval sides_past_railing(const scan::PointCloud& cloud, const JointFit& fit, const RailingOptions& options) {
  constexpr double kFarthestInset_m = 0.3;
  const Railing railing = find_railing(cloud, fit.model, fit.sides, fit.first, fit.last, options);
  Interval sides = fit.sides;
  const auto is_beyond = [](double limit, double end) { return limit > end && limit < end + kFarthestInset_m; };
  if (railing.left && fit.left_limit && is_beyond(*fit.left_limit, sides.high)) sides.high = *fit.left_limit;
  if (railing.right && fit.right_limit && is_beyond(-*fit.right_limit, -sides.low)) sides.low = *fit.right_limit;
  return sides;
}

// Fits every winner to the points; those that the points do not bear out are named in the answer.
std::vector<FittedStairway> refine(const scan::PointCloud& cloud, const std::vector<Winner>& winners,
                                   const std::vector<StairPart>& parts, const DetectorOptions& options,
                                   Detection& detection) {
  std::vector<FittedStairway> fitted;
  const CompetitionOptions& rules = options.competition;
  for (const Winner& winner : winners) {
    const Interval sides = from_parts(winner, parts).sides;
    const std::optional<JointFit> joint = fit_jointly(cloud, winner.graph, sides, winner.view, options.joint_fit);
    const std::string rule =
        joint ? broken_rule(*joint, rules.initialisation.limits, rules.confirmation, options.joint_fit)
              : std::string("no-points-on-steps");
    if (rule.empty()) {
      fitted.push_back(as_fitted(*joint, winner));
      fitted.back().sides = sides_past_railing(cloud, *joint, options.railing);
    } else {
      detection.rejected.push_back(rejection(rule, joint ? joint->model : winner.graph.model,
                                             joint ? joint->seen_steps : 0, rules.confirmation));
    }
  }
  return fitted;
}

// The floor may slope away from where the robot stands.
void begin_on_floor(const std::optional<SceneLevel>& level, std::vector<FittedStairway>& fitted) {
  if (!level) return;
  for (FittedStairway& stairway : fitted)
    if (stairway.view == View::FromBelow)
      stairway.floor_m = level->floor_at(stairway.model.step(stairway.first).nosing);
}

Detection detect_in_level_cloud(const scan::PointCloud& cloud, const scan::PointCloud& segmented,
                                std::vector<PlaneRegion> regions, const std::optional<SceneLevel>& level,
                                const DetectorOptions& options, const StageListener& on_stage) {
  regions = merge_fragments(segmented, std::move(regions), options.plane_finder, options.fragment_merging);
  const std::vector<StairPart> parts = find_parts(segmented, regions, options.plane_finder);
  begin_stage(on_stage, "stair_graph");
  const CompetitionResult competition = compete(parts, options.competition);
  begin_stage(on_stage, "fit");
  Detection detection;
  detection.level = level;
  if (competition.runner_up) detection.rejected.push_back(*competition.runner_up);
  std::vector<FittedStairway> fitted;
  if (options.competition.strategy == Strategy::Joint) {
    fitted = refine(cloud, competition.winners, parts, options, detection);
  } else {
    for (const Winner& winner : competition.winners) fitted.push_back(from_parts(winner, parts));
  }
  if (fitted.empty())
    explain_silence(cloud_fault(cloud, segmented, regions, options.segmentation.min_points()), regions.size(), parts,
                    detection.rejected);
  begin_stage(on_stage, "railing");
  fitted = without_duplicates(std::move(fitted));
  begin_on_floor(level, fitted);
  begin_on_landings(fitted);
  for (FittedStairway& stairway : fitted)
    stairway.railing =
        find_railing(cloud, stairway.model, stairway.sides, stairway.first, stairway.last, options.railing);
  begin_stage(on_stage, "localisation");
  for (const FittedStairway& stairway : fitted) detection.stairways.push_back(localise(stairway, options.localisation));
  return detection;
}

}  // namespace

std::string DetectorOptions::problem() const {
  if (!(voxel_m > 0.0)) return "voxel_m must be greater than 0";
  if (threads < 1 || threads > 64) return "threads must lie between 1 and 64";
  for (const std::string& problem :
       {segmentation.problem(), level.problem(), plane_finder.problem(), fragment_merging.problem(),
        competition.problem(), joint_fit.problem(), railing.problem(), localisation.problem()})
    if (!problem.empty()) return problem;
  return {};
}

Detection detect_stairways(const scan::PointCloud& cloud, const DetectorOptions& options,
                           const StageListener& on_stage) {
  const bool by_patches = options.segmentation.uses_patches();
  scan::PointCloud thinned;
  if (!by_patches) {
    begin_stage(on_stage, "voxel_grid");
    thinned = voxel_centroids(cloud, options.voxel_m);
  }
  std::vector<PlaneRegion> regions =
      by_patches ? segment_by_patches(cloud, options.voxel_m, options.segmentation, on_stage, options.threads)
                 : segment(thinned, options.segmentation, on_stage, options.threads);
  begin_stage(on_stage, "plane_finder");
  const std::optional<SceneLevel> level = options.level.enabled ? level_by_scene(regions, options.level) : std::nullopt;
  if (!level)
    return detect_in_level_cloud(cloud, by_patches ? cloud : thinned, std::move(regions), level, options, on_stage);
  transform(regions, level->T_level_cloud);
  const scan::PointCloud level_cloud = transformed(cloud, level->T_level_cloud);
  if (!by_patches) thinned = transformed(thinned, level->T_level_cloud);
  return detect_in_level_cloud(level_cloud, by_patches ? level_cloud : thinned, std::move(regions), level, options,
                               on_stage);
}

}  // namespace stairway::detect
