// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "detector/graph_initialisation.hpp"

#include <cmath>
#include <numbers>

#include "detector/deviation.hpp"
#include "detector/part_grid.hpp"
#include "detector/spiral_initialisation.hpp"

namespace stairway::detect {
namespace {

struct Pair {
  const StairPart& lower;
  const StairPart& upper;
};

double horizontal_distance(const Pair& pair) { return (pair.upper.centroid - pair.lower.centroid).head<2>().norm(); }

bool side_by_side(const Pair& pair, const StairModel& model, double min_overlap_m) {
  return overlap(sides_of(pair.lower, model.step(0)), sides_of(pair.upper, model.step(1))) >= min_overlap_m;
}

Eigen::Vector3d towards_descent(const Eigen::Vector3d& direction, const Pair& pair) {
  return direction.dot(pair.lower.centroid - pair.upper.centroid) < 0.0 ? Eigen::Vector3d(-direction) : direction;
}

StairModel model_at(const Pair& pair, double height, double depth, const Eigen::Vector3d& descent, double front,
                    double top) {
  Eigen::Vector3d nosing = 0.5 * (pair.lower.end_a + pair.lower.end_b);
  nosing += descent * (front - nosing.dot(descent));
  nosing.z() = top;
  return {.height_m = height, .depth_m = depth, .descent = descent, .nosing = nosing};
}

std::vector<StairModel> from_risers(const Pair& pair, const InitialisationOptions& options) {
  const double agreement = pair.lower.facing.dot(pair.upper.facing);
  if (std::abs(agreement) < std::cos(options.max_riser_angle_rad)) return {};
  const Eigen::Vector3d sum = pair.lower.facing + (agreement < 0.0 ? -1.0 : 1.0) * pair.upper.facing;
  const Eigen::Vector3d s = towards_descent(sum.normalized(), pair);
  const double depth = (pair.lower.centroid - pair.upper.centroid).dot(s);
  const double front = pair.lower.centroid.dot(s);
  const double h_tt = pair.upper.top.z() - pair.lower.top.z();
  const double h_bb = pair.upper.bottom.z() - pair.lower.bottom.z();
  return {model_at(pair, h_tt, depth, s, front, pair.lower.top.z()),
          model_at(pair, h_bb, depth, s, front, pair.lower.bottom.z() + h_bb)};
}

// Ours: the bars of two open treads, their middles a step apart.
std::vector<StairModel> from_edges(const Pair& pair, const InitialisationOptions& options) {
  const double agreement = pair.lower.facing.dot(pair.upper.facing);
  if (std::abs(agreement) < std::cos(options.max_riser_angle_rad)) return {};
  const Eigen::Vector3d sum =
      pair.lower.width() * pair.lower.facing + (agreement < 0.0 ? -1.0 : 1.0) * pair.upper.width() * pair.upper.facing;
  const Eigen::Vector3d s = towards_descent(sum.normalized(), pair);
  const Eigen::Vector3d apart = pair.upper.centroid - pair.lower.centroid;
  return {model_at(pair, apart.z(), -apart.dot(s), s, pair.lower.centroid.dot(s), pair.lower.centroid.z())};
}

std::vector<StairModel> from_treads(const Pair& pair) {
  if (pair.lower.from_below != pair.upper.from_below) return {};
  const double height = pair.upper.centroid.z() - pair.lower.centroid.z();
  const double thickness = pair.lower.from_below ? kTypicalTreadThickness_m : 0.0;
  const double top = pair.lower.centroid.z() + thickness;
  std::vector<StairModel> models;
  for (const StairPart* part : {&pair.lower, &pair.upper}) {
    const Eigen::Vector3d s = towards_descent(part->facing, pair);
    const Interval lower = part_extent(pair.lower, s);
    const Interval upper = part_extent(pair.upper, s);
    const double d_ff = lower.high - upper.high;
    const double d_bb = lower.low - upper.low;
    models.push_back(model_at(pair, height, d_ff, s, lower.high, top));
    models.push_back(model_at(pair, height, d_bb, s, lower.low + d_bb, top));
  }
  for (StairModel& model : models) model.tread_thickness_m = thickness;
  return models;
}

std::vector<StairModel> suggested_flights(const Pair& pair, const InitialisationOptions& options) {
  switch (pair.lower.kind) {
    case StairPart::Kind::Riser:
      return from_risers(pair, options);
    case StairPart::Kind::Tread:
      return from_treads(pair);
    case StairPart::Kind::Edge:
      break;
  }
  return from_edges(pair, options);
}

std::vector<StairModel> suggested_models(const Pair& pair, const InitialisationOptions& options) {
  std::vector<StairModel> models = suggested_flights(pair, options);
  if (options.spirals) {
    const std::vector<StairModel> spirals = suggested_spirals(pair.lower, pair.upper);
    models.insert(models.end(), spirals.begin(), spirals.end());
  }
  return models;
}

}  // namespace

std::string InitialisationOptions::problem() const {
  if (std::string problem = limits.problem(); !problem.empty()) return problem;
  if (!(max_pair_distance_m > 0.0)) return "max_pair_distance_m must be greater than 0";
  if (!(max_riser_angle_rad > 0.0 && max_riser_angle_rad < std::numbers::pi / 2))
    return "max_riser_angle must lie between 0 and 90 degrees";
  return {};
}

std::vector<Initialisation> initialise_graphs(const std::vector<StairPart>& parts,
                                              const InitialisationOptions& options) {
  // Edges of half-hidden parts misjudge h; the limits proper are put to the models.
  constexpr double kEdgeSlack_m = 0.15;
  const PartGrid grid(parts, options.max_pair_distance_m);
  std::vector<std::size_t> near;
  std::vector<Initialisation> initialisations;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    grid.around(parts[i].centroid.head<2>(), options.max_pair_distance_m, near);
    for (const std::size_t k : near) {
      const Pair pair{parts[i], parts[k]};
      const double rise = pair.upper.centroid.z() - pair.lower.centroid.z();
      if (i == k || pair.lower.kind != pair.upper.kind || rise < 0.0 ||
          rise > options.limits.max_height_m + kEdgeSlack_m || horizontal_distance(pair) > options.max_pair_distance_m)
        continue;
      for (const StairModel& model : suggested_models(pair, options)) {
        if (options.limits.allow(model) && side_by_side(pair, model, options.min_side_overlap_m))
          initialisations.push_back({model, {i, k}});
      }
    }
  }
  return initialisations;
}

}  // namespace stairway::detect
