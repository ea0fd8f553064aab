// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "config/settings.hpp"
#include "detector/stairway.hpp"
#include "tools/evaluation/depth_set.hpp"
#include "tools/sim/helmet_scene.hpp"

namespace stairway::evaluation {

/// What was found on one frame of a depth camera.
struct DepthFrame {
  FrameLabel label = FrameLabel::None;
  bool is_found = false;            ///< a stairway for the stairs that are there; of a recorded frame, any stairway
  std::size_t others = 0;           ///< stairways that are not there
  std::vector<bool> in_view;        ///< per true step, nearest first; empty where no truth is known
  std::vector<bool> is_step_found;  ///< likewise
  std::optional<double> height_error_m, depth_error_m, heading_error_rad;
};

/// Sets what depends on the answer. A stairway is the true one when it has its direction and at least three of its
/// steps: nosings that lie within half the way from nosing to nosing of the true one's line.
void compare(DepthFrame& frame, const detect::Stairway& truth, const std::vector<detect::Stairway>& found);

/// Takes a picture of sim::random_helmet_scene() with a Kinect, places it by the gravity that its owner knows, and
/// looks for stairs. Cost: about 2 s of one core.
DepthFrame simulated_depth_frame(sim::HelmetSubject subject, std::uint64_t seed,
                                 const detect::DetectorOptions& detector);

/// The same in a recorded cloud, turned by its gravity, then onto its floor if `settings.input.level` says so. Throws
/// std::runtime_error when the cloud cannot be read.
DepthFrame recorded_depth_frame(const LabelledFrame& labelled, const config::Settings& settings);

}  // namespace stairway::evaluation
