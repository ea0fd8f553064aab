// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "tools/evaluation/depth_frame.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "detector/levelling.hpp"
#include "detector/stairway_detector.hpp"
#include "ipc/cloud_file.hpp"
#include "tools/sim/depth_camera.hpp"

namespace stairway::evaluation {
namespace {

constexpr std::ptrdiff_t kLeastSteps = 3;

detect::Nosing nearest_first(const detect::Stairway& stairway, std::size_t i) {
  const bool is_up = stairway.direction == detect::StairwayDirection::Ascending;
  return is_up ? stairway.nosings[i] : stairway.nosings[stairway.nosings.size() - 1 - i];
}

// The found one may know less of the width: its nosing must lie on the true one's line, between its ends.
bool is_same_step(const detect::Nosing& found, const detect::Nosing& truth, double reach_m) {
  const Eigen::Vector3d across = truth.left - truth.right;
  const Eigen::Vector3d p = (found.left + found.right) / 2 - truth.right;
  const double share = std::clamp(p.dot(across) / across.squaredNorm(), 0.0, 1.0);
  return (p - share * across).norm() < reach_m;
}

std::vector<bool> steps_found(const detect::Stairway& truth, const detect::Stairway& found) {
  const double reach = 0.5 * std::hypot(truth.step_height, truth.step_depth);
  std::vector<bool> result;
  for (std::size_t i = 0; i < truth.nosings.size(); ++i) {
    const detect::Nosing step = nearest_first(truth, i);
    result.push_back(std::any_of(found.nosings.begin(), found.nosings.end(),
                                 [&](const detect::Nosing& nosing) { return is_same_step(nosing, step, reach); }));
  }
  return result;
}

}  // namespace

void compare(DepthFrame& frame, const detect::Stairway& truth, const std::vector<detect::Stairway>& found) {
  frame.is_step_found.assign(truth.nosings.size(), false);
  for (const detect::Stairway& stairway : found) {
    const std::vector<bool> steps = steps_found(truth, stairway);
    const bool is_it =
        stairway.direction == truth.direction && std::count(steps.begin(), steps.end(), true) >= kLeastSteps;
    if (!is_it || frame.is_found) {
      ++frame.others;
      continue;
    }
    frame.is_found = true;
    frame.is_step_found = steps;
    frame.height_error_m = stairway.step_height - truth.step_height;
    frame.depth_error_m = stairway.step_depth - truth.step_depth;
    frame.heading_error_rad = std::remainder(stairway.heading - truth.heading, 2 * std::numbers::pi);
  }
}

DepthFrame simulated_depth_frame(sim::HelmetSubject subject, std::uint64_t seed,
                                 const detect::DetectorOptions& detector) {
  const sim::HelmetScene view = sim::random_helmet_scene(seed, subject);
  const sim::Scene scene = sim::build_scene(view.scene);
  const sim::DepthCameraOptions camera;
  const sim::DepthImage image = sim::simulate_depth_image(scene, view.pose, camera, seed);
  const auto found = detect_stairways(sim::to_cloud(image, camera.intrinsics, view.assumed), detector).stairways;
  DepthFrame frame;
  if (scene.truths.empty()) {
    frame.others = found.size();
    return frame;
  }
  const detect::Stairway& truth = scene.truths.front();
  frame.label = subject == sim::HelmetSubject::Ascending ? FrameLabel::Ascending : FrameLabel::Descending;
  frame.in_view = sim::nosings_in_view(truth, view.pose);
  if (frame.label == FrameLabel::Descending) std::reverse(frame.in_view.begin(), frame.in_view.end());
  compare(frame, truth, found);
  return frame;
}

DepthFrame recorded_depth_frame(const LabelledFrame& labelled, const config::Settings& settings) {
  auto loaded = ipc::read_cloud_file(labelled.cloud);
  if (!loaded) throw std::runtime_error(loaded.error().text);
  scan::PointCloud cloud = std::move(loaded->cloud);
  if (!cloud.sensor_origin && labelled.gravity) cloud.sensor_origin = Eigen::Vector3f::Zero();
  if (labelled.gravity) cloud = detect::transformed(cloud, detect::upright_from_gravity(*labelled.gravity));
  if (settings.input.level == config::Levelling::Floor) {
    if (const auto floor = detect::find_floor(cloud)) cloud = detect::transformed(cloud, floor->T_level_cloud);
  }
  const std::size_t found = detect_stairways(cloud, settings.detector).stairways.size();
  DepthFrame frame{.label = labelled.label};
  frame.is_found = labelled.label != FrameLabel::None && found > 0;
  frame.others = frame.is_found ? 0 : found;
  return frame;
}

}  // namespace stairway::evaluation
