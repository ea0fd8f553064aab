// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "tools/evaluation/accuracy_run.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "detector/levelling.hpp"
#include "detector/stairway_detector.hpp"
#include "tools/common/stairway_match.hpp"
#include "tools/sim/random.hpp"
#include "tools/sim/sweep.hpp"

namespace stairway::evaluation {
namespace {

detect::Stairway turned(detect::Stairway stairway, double yaw_rad) {
  const Eigen::AngleAxisd turn(yaw_rad, Eigen::Vector3d::UnitZ());
  for (detect::Nosing& nosing : stairway.nosings) {
    nosing.left = turn * nosing.left;
    nosing.right = turn * nosing.right;
  }
  stairway.anchor = turn * stairway.anchor;
  stairway.heading = std::remainder(stairway.heading + yaw_rad, 2.0 * std::numbers::pi);
  return stairway;
}

std::size_t nearest_nosing(const Eigen::Vector3d& to, const detect::Stairway& stairway) {
  const auto nearest = std::min_element(stairway.nosings.begin(), stairway.nosings.end(),
                                        [&](const detect::Nosing& a, const detect::Nosing& b) {
                                          return (a.middle() - to).squaredNorm() < (b.middle() - to).squaredNorm();
                                        });
  return static_cast<std::size_t>(nearest - stairway.nosings.begin());
}

}  // namespace

std::vector<detect::Stairway> levelled_truths(const sim::Scene& scene, const sim::ScannerOptions& scanner) {
  const Eigen::Isometry3d T_scene_base =
      detect::upright_from_roll_pitch(scanner.robot_roll_rad, scanner.robot_pitch_rad);
  const Eigen::Vector3d up = T_scene_base.linear().transpose() * Eigen::Vector3d::UnitZ();
  const Eigen::Isometry3d T_level_base = detect::upright_from_gravity(-up);
  const Eigen::Vector3d x = (T_level_base * T_scene_base.inverse()).linear() * Eigen::Vector3d::UnitX();
  std::vector<detect::Stairway> truths;
  for (const detect::Stairway& truth : scene.truths) truths.push_back(turned(truth, std::atan2(x.y(), x.x())));
  return truths;
}

std::vector<double> step_height_errors(const detect::Stairway& found, const detect::Stairway& truth) {
  std::vector<double> errors;
  for (std::size_t i = 1; i < found.nosings.size(); ++i) {
    const Eigen::Vector3d lower = found.nosings[i - 1].middle();
    const Eigen::Vector3d upper = found.nosings[i].middle();
    const std::size_t below = nearest_nosing(lower, truth);
    const std::size_t above = nearest_nosing(upper, truth);
    if (above != below + 1) continue;
    errors.push_back(upper.z() - lower.z() - (truth.nosings[above].middle().z() - truth.nosings[below].middle().z()));
  }
  return errors;
}

AccuracyRun run_accuracy_case(const AccuracyCase& of, const Request& request, std::size_t index) {
  const std::uint64_t seed = request.seed + index;
  const sim::Scene scene = sim::build_scene(of.scene(seed));
  const sim::ScannerOptions scanner = of.scanner(seed);
  const double usual_s = request.settings.disk.period_s;
  const double period_s = of.longest_period_s > 0.0 ? std::min(of.longest_period_s, usual_s) : usual_s;
  const scan::MountOptions mount = scene.mount.value_or(request.settings.mount);
  const scan::PointCloud cloud = sim::simulate_sweep(scene, mount, scanner, {.disk_period_s = period_s, .threads = 1},
                                                     sim::Random{~request.seed, index}.next());
  const detect::Detection detection = detect::detect_stairways(cloud, request.settings.detector);

  AccuracyRun run;
  const std::vector<detect::Stairway> truths = levelled_truths(scene, scanner);
  const auto pairs = tools::match(truths, detection.stairways);
  run.outcome.false_count = static_cast<int>(detection.stairways.size() - pairs.size());
  if (!pairs.empty()) {
    const auto& [truth, found] = pairs.front();
    run.found = detection.stairways[found];
    run.outcome.error = error_of(*run.found, truths[truth]);
    run.step_height_errors_m = step_height_errors(*run.found, truths[truth]);
  }
  if (!truths.empty()) run.bound = accuracy_bound(scene, mount, {.disk_period_s = period_s});
  return run;
}

}  // namespace stairway::evaluation
