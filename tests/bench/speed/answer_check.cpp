// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/bench/speed/answer_check.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "tools/evaluation/stairway_error.hpp"

namespace stairway::bench {
namespace {

// All flights here run along x or y.
Eigen::AlignedBox3f box_around(const detect::Stairway& truth) {
  Eigen::AlignedBox3f box;
  for (const detect::Nosing& nosing : truth.nosings) {
    box.extend(nosing.left.cast<float>());
    box.extend(nosing.right.cast<float>());
  }
  return box;
}

bool is_seen(const detect::Stairway& truth, const scan::PointCloud& cloud) {
  constexpr long kPointsOfStep = 1500;
  const Eigen::AlignedBox3f box = box_around(truth);
  const auto inside = std::count_if(cloud.points.begin(), cloud.points.end(),
                                    [&](const Eigen::Vector3f& point) { return box.contains(point); });
  return inside >= kPointsOfStep * static_cast<long>(truth.nosings.size());
}

}  // namespace

AnswerCheck check_answer(const scan::PointCloud& cloud, const detect::Detection& detection,
                         const std::vector<detect::Stairway>& truths, const Demands& demands) {
  constexpr double kFewestFound = 0.9;
  AnswerCheck check;
  for (std::size_t i = 0; i < truths.size(); ++i) {
    if (!is_seen(truths[i], cloud)) continue;
    ++check.seen;
    const evaluation::Outcome outcome = evaluation::outcome_of(detection, truths, i);
    if (!outcome.error) continue;
    ++check.found;
    check.worst_height_error_mm = std::max(check.worst_height_error_mm, 1e3 * std::abs(outcome.error->height_m));
  }
  if (check.seen < demands.fewest_seen) throw std::runtime_error("the cloud does not hold the flight it should");
  if (check.found < kFewestFound * check.seen)
    throw std::runtime_error(fmt::format("{} of {} flights in sight were found", check.found, check.seen));
  if (check.worst_height_error_mm > demands.max_height_error_mm)
    throw std::runtime_error(fmt::format("a step height is wrong by {:.1f} mm", check.worst_height_error_mm));
  return check;
}

}  // namespace stairway::bench
