// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

#include "detector/plane_region.hpp"
#include "scan_assembly/point_cloud.hpp"
#include "tools/evaluation/truth_plane.hpp"
#include "tools/sim/bvh.hpp"

namespace stairway::evaluation {

inline constexpr std::uint32_t kNoPlane = ~std::uint32_t{0};

/// The paper's rules for what a perfect segmentation would find (sections "Ground Truth Generation" and "Evaluation
/// Criteria").
struct TruthRules {
  double raster_m = 0.01;           ///< of the places of a plane whose visibility is looked at
  double margin_m = 0.005;          ///< of those places from the border of the plane
  double max_distance_m = 0.05;     ///< point to its plane, and region to its plane
  int min_points = 30;              ///< a plane with fewer is not detectable
  double max_angle_rad = 0.261799;  ///< between the normals of a region and its plane; 15 degrees
  double cell_m = 0.05;             ///< of the grid on which the overlap is counted
  double min_overlap = 0.5;         ///< of the cells of a region, so many must be cells of its plane
};

/// Whether some place of the plane can be seen from `sensor`; `scene` may hold the plane itself.
bool is_visible(const TruthPlane& plane, const sim::Bvh& scene, const Eigen::Vector3f& sensor, const TruthRules& rules);

/// Which plane each point of a cloud was measured on.
struct PointTruth {
  std::vector<std::uint32_t> plane_of;  ///< by point, kNoPlane where it is none or one that is not detectable
  std::vector<bool> is_detectable;      ///< by plane: visible, and with at least `min_points` points
};

/// Assigns each point to the nearest visible plane, unless that is too far, or the place on the plane that is nearest
/// to the point cannot be seen. A point beyond an edge is as near to either plane and may go to any of them.
///
/// @param planes  of the stairway.
/// @param others  of the room around it: a point that is nearer to one of them is none of the stairway's. The paper has
/// no such planes, as its model holds the stairway alone.
/// @param cloud   needs a sensor origin.
PointTruth assign_points(const scan::PointCloud& cloud, std::span<const TruthPlane> planes,
                         std::span<const TruthPlane> others, const sim::Bvh& scene, const TruthRules& rules = {});

/// For each region the detectable plane that it found, the one it overlaps most; kNoPlane when there is none.
///
/// Overlap is the share of the region's cells that hold some of the plane, as the paper computes it: a region may cover
/// little of the plane, but must not reach far beyond it.
std::vector<std::uint32_t> match_regions(std::span<const detect::PlaneRegion> regions,
                                         std::span<const Eigen::Vector3f> points, std::span<const TruthPlane> planes,
                                         const std::vector<bool>& is_detectable, const TruthRules& rules = {});

/// The paper's four measures under the names in common use. The paper calls the recalls precision and the other way
/// round: its "precision" (eq 21) divides by what there is, its "recall" (eq 22) by what was found.
struct SegmentationMeasures {
  double plane_recall = 0.0;     ///< planes found of the detectable ones (eq 21, the paper's plane precision)
  double plane_precision = 0.0;  ///< planes found per region that found one (eq 22, the paper's plane recall)
  double point_recall = 0.0;     ///< points in the right region of the points of all planes (eqs 23, 24)
  double point_precision = 0.0;  ///< of the points of all regions that found a plane (eq 25)
};

/// @param match_of  by region, from match_regions().
SegmentationMeasures measure(std::span<const detect::PlaneRegion> regions, std::span<const std::uint32_t> match_of,
                             const PointTruth& truth);

}  // namespace stairway::evaluation
