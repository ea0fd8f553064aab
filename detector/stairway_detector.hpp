// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "detector/competition.hpp"
#include "detector/fragment_merging.hpp"
#include "detector/joint_fit.hpp"
#include "detector/level_by_scene.hpp"
#include "detector/localisation.hpp"
#include "detector/plane_finder.hpp"
#include "detector/railing.hpp"
#include "detector/segmentation.hpp"
#include "detector/stage_listener.hpp"
#include "detector/stairway.hpp"
#include "scan_assembly/point_cloud.hpp"

namespace stairway::detect {

struct DetectorOptions {
  double voxel_m = 0.01;  ///< edge of the thinning cells [m], > 0; the paper's 1 cm
  int threads = 2;        ///< that look for planes at once, 1..64; the answer is the same for any number
  SegmentationOptions segmentation;
  SceneLevelOptions level;
  PlaneFinderOptions plane_finder;
  FragmentMergingOptions fragment_merging;
  CompetitionOptions competition;
  JointFitOptions joint_fit;
  RailingOptions railing;
  LocalisationOptions localisation;

  /// First problem found, worded for the person who set it; empty when usable.
  std::string problem() const;
};

/// Finds the stairways in a cloud (the paper's Fig 4, from the input cloud to the localized stairway).
///
/// @param cloud  points in the `base` frame, z up, floor at z = 0 [m]; points that are not finite are ignored.
/// @return stairways by falling evidence; when there is none, `rejected` says how far the best candidate came.
/// Never throws on any cloud. Deterministic, whatever `options.threads`. Cost: O(N log N) in the number of points.
Detection detect_stairways(const scan::PointCloud& cloud, const DetectorOptions& options = {},
                           const StageListener& on_stage = {});

}  // namespace stairway::detect
