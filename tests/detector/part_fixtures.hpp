// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <vector>

#include "detector/stair_model.hpp"
#include "detector/stair_part.hpp"
#include "scan_assembly/point_cloud.hpp"

namespace stairway::detect::test {

/// The model of a flight that climbs along `heading_rad`, its first nosing in the middle at `foot`.
inline StairModel make_model(double height_m, double depth_m, double heading_rad = 0.0,
                             const Eigen::Vector3d& foot = {2.0, 0.0, 0.17}) {
  StairModel model;
  model.height_m = height_m;
  model.depth_m = depth_m;
  model.descent = -Eigen::Vector3d(std::cos(heading_rad), std::sin(heading_rad), 0.0);
  model.nosing = foot;
  return model;
}

/// The riser of step `number` exactly where the model has it; its top `hidden_m` of height may be cut off below.
inline StairPart riser_of(const StairModel& model, int number, double width_m = 1.2, double hidden_m = 0.0) {
  const StepFrame step = model.step(number);
  StairPart part;
  part.kind = StairPart::Kind::Riser;
  part.facing = step.descent;
  part.top = step.nosing;
  part.bottom = step.nosing - Eigen::Vector3d(0, 0, model.height_m - hidden_m);
  part.centroid = part.front = part.back = 0.5 * (part.top + part.bottom);
  part.end_a = part.centroid - step.left() * (0.5 * width_m);
  part.end_b = part.centroid + step.left() * (0.5 * width_m);
  part.point_count = 100;
  return part;
}

/// The whole tread of step `number` exactly where the model has it.
inline StairPart tread_of(const StairModel& model, int number, double width_m = 1.2) {
  const StepFrame step = model.step(number);
  StairPart part;
  part.kind = StairPart::Kind::Tread;
  part.facing = step.descent;
  part.front = step.nosing;
  part.back = step.nosing - model.depth_m * step.descent;
  part.centroid = part.top = part.bottom = 0.5 * (part.front + part.back);
  part.end_a = part.centroid - step.left() * (0.5 * width_m);
  part.end_b = part.centroid + step.left() * (0.5 * width_m);
  part.point_count = 100;
  return part;
}

/// Numbers the parts as if each came from a region of its own.
inline std::vector<StairPart> with_regions(std::vector<StairPart> parts) {
  for (std::size_t i = 0; i < parts.size(); ++i) parts[i].region = i;
  return parts;
}

/// Risers of steps 0 .. count - 1.
inline std::vector<StairPart> flight_of_risers(const StairModel& model, int count) {
  std::vector<StairPart> parts;
  for (int number = 0; number < count; ++number) parts.push_back(riser_of(model, number));
  return with_regions(std::move(parts));
}

/// A grid of points on the rectangle spanned from `corner` by `a` and `b`, `step_m` apart.
inline void add_rectangle(scan::PointCloud& cloud, const Eigen::Vector3d& corner, const Eigen::Vector3d& a,
                          const Eigen::Vector3d& b, double step_m) {
  const int rows = static_cast<int>(a.norm() / step_m);
  const int columns = static_cast<int>(b.norm() / step_m);
  for (int i = 0; i <= rows; ++i)
    for (int k = 0; k <= columns; ++k) cloud.points.push_back((corner + a * i / rows + b * k / columns).cast<float>());
}

}  // namespace stairway::detect::test
