// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "detector/plane_region.hpp"
#include "detector/scene_level.hpp"

namespace stairway::detect {

struct SceneLevelOptions {
  bool enabled = true;
  double max_tilt_rad = std::numbers::pi / 22.5;  ///< 8 deg: of the cloud against level [rad], in (0, pi/8)
  double max_sigma_rad = std::numbers::pi / 900;  ///< 0.2 deg: what is less certain is not used [rad], > 0

  std::string problem() const;
};

/// Estimates up from the planes of a scene: those that are nearly level are taken for level, those that are nearly
/// upright for upright, and what does not agree with most others (ramps, lids, leaning boards) is set aside. Floors may
/// slope for drainage, so the other planes are trusted more than they are. z of the cloud is roughly up.
///
/// @return nothing when up is less certain than `max_sigma_rad` or farther from z than `max_tilt_rad`.
/// Cost: linear in the number of regions.
std::optional<SceneLevel> level_by_scene(const std::vector<PlaneRegion>& regions,
                                         const SceneLevelOptions& options = {});

/// Regions in another frame.
void transform(std::vector<PlaneRegion>& regions, const Eigen::Isometry3d& transform);

}  // namespace stairway::detect
