// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "detector/scene_level.hpp"

namespace stairway::detect {

enum class StairwayKind { Straight, Spiral };
enum class StairwayDirection { Ascending, Descending };  ///< seen from the floor the robot stands on (z = 0)
enum class AnchorSide { Left, Middle, Right };           ///< seen while ascending

/// The names that people and machines read everywhere: "straight", "ascending", "left" and so on.
std::string_view to_string(StairwayKind kind);
std::string_view to_string(StairwayDirection direction);
std::string_view to_string(AnchorSide side);

/// The top front edge of one tread, its ends named as seen while ascending; `base` frame [m].
struct Nosing {
  Eigen::Vector3d left = Eigen::Vector3d::Zero();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();

  Eigen::Vector3d middle() const { return 0.5 * (left + right); }
  /// One of its ends or its middle.
  Eigen::Vector3d at(AnchorSide side) const;
};

/// One step on its own, from the nosing below to its nosing, or from the floor to the first one [m].
struct StepSize {
  double height = 0.0;
  double height_sigma = 0.0;
  double depth = 0.0;
  double depth_sigma = 0.0;
};

/// A stairway as the locomotion controller wants it; `base` frame, metres and radians.
/// The simulator states its truth in the same form.
struct Stairway {
  StairwayKind kind = StairwayKind::Straight;
  StairwayDirection direction = StairwayDirection::Ascending;
  double step_height = 0.0;    ///< vertical distance of neighbouring treads, h [m]
  double step_depth = 0.0;     ///< horizontal distance of neighbouring nosings, d; on a spiral at mid width [m]
  double width = 0.0;          ///< w [m]
  double heading = 0.0;        ///< horizontal direction of ascent, counter-clockwise from x, (-pi, pi] [rad]
  double turn_per_step = 0.0;  ///< the paper's delta phi; positive when the ascent turns left, 0 when straight [rad]
  double step_height_sigma = 0.0;  ///< one standard deviation, from the fit [m]
  double step_depth_sigma = 0.0;   ///< likewise [m]
  double width_sigma = 0.0;        ///< likewise [m]
  double heading_sigma = 0.0;      ///< likewise [rad]
  Eigen::Vector3d anchor =
      Eigen::Vector3d::Zero();  ///< the nosing where the robot meets the stairway, at `anchor_side` [m]
  AnchorSide anchor_side = AnchorSide::Middle;
  bool railing_left = false;
  bool railing_right = false;
  std::vector<Nosing> nosings;  ///< every nosing, lowest first, the edge of the upper landing included
  /// Of every nosing in turn. Those of a regular stairway are all alike; those of an irregular one as they were
  /// measured where they were, with the sigmas of the whole where they were not.
  std::vector<StepSize> step_sizes;
  bool is_irregular = false;  ///< its steps differ by more than their measurements' errors explain
  double score = 0.0;         ///< eq 2; comparable only within one cloud

  /// The nosing where the robot meets the stairway: the lowest of an ascending one, the highest of a descending one.
  /// @pre there are nosings.
  const Nosing& met_nosing() const;

  /// Inclination of the line of nosings [rad].
  double pitch() const;
};

/// The best candidate that failed a rule, so that an empty answer has a reason.
struct Rejection {
  std::string reason;                                   ///< machine-readable rule name, e.g. "too-few-steps"
  std::string detail;                                   ///< the same for a person, with the figures
  std::vector<std::pair<std::string, double>> figures;  ///< what was measured and the limit it missed
};

/// The answer for one cloud.
struct Detection {
  std::vector<Stairway> stairways;  ///< the one with most evidence first
  std::vector<Rejection> rejected;
  /// How the cloud was turned before anything was looked for; nothing when the scene did not say. What was found is
  /// told in the levelled frame.
  std::optional<SceneLevel> level;
};

}  // namespace stairway::detect
