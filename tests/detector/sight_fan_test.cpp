// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "detector/sight_fan.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <random>
#include <vector>

namespace stairway::detect {
namespace {

using Eigen::Vector3d;

const Vector3d kSensor{0.3, -0.2, 1.0};

std::vector<Vector3d> points_all_around() {
  std::mt19937 engine(5);
  std::uniform_real_distribution<double> place(-4.0, 4.0);
  std::vector<Vector3d> points(20000);
  for (Vector3d& p : points) p = {place(engine), place(engine), place(engine)};
  return points;
}

std::vector<Vector3d> box(const Vector3d& low, const Vector3d& high) {
  std::vector<Vector3d> corners;
  for (int i = 0; i < 8; ++i)
    corners.emplace_back((i & 1) ? low.x() : high.x(), (i & 2) ? low.y() : high.y(), (i & 4) ? low.z() : high.z());
  return corners;
}

/// Whether the way from the sensor to a point and beyond meets the box at or before the point.
bool is_within_or_behind(const Vector3d& p, const Vector3d& low, const Vector3d& high) {
  constexpr int kSamples = 400;
  for (int i = 1; i <= kSamples; ++i) {
    const Vector3d at = kSensor + (p - kSensor) * (static_cast<double>(i) / kSamples);
    if ((at.array() >= low.array()).all() && (at.array() <= high.array()).all()) return true;
  }
  return false;
}

TEST(SightFan, holds_every_point_within_a_box_or_behind_it_wherever_the_box_lies) {
  const std::vector<std::pair<Vector3d, Vector3d>> boxes = {{{1.0, -0.5, 0.2}, {1.4, 0.5, 0.4}},    // ahead
                                                            {{-2.0, -0.5, 0.2}, {-1.6, 0.5, 0.4}},  // behind the sensor
                                                            {{0.2, -0.5, 2.0}, {0.5, 0.5, 2.2}},    // above it
                                                            {{0.1, -0.5, -1.0}, {0.6, 0.5, -0.8}},  // beneath it
                                                            {{0.0, -0.5, 0.8}, {0.6, 0.5, 1.2}}};   // around it
  const Vector3d level(std::cos(0.2), std::sin(0.2), 0.0);
  for (const auto& [start, ahead] : {std::pair<Vector3d, Vector3d>(Vector3d::UnitZ(), level),
                                     std::pair<Vector3d, Vector3d>(level, Vector3d::UnitZ().cross(level))}) {
    std::vector<Vector3d> points = points_all_around();
    const SightFan fan(points, kSensor, start, ahead);
    for (const auto& [low, high] : boxes) {
      SCOPED_TRACE(::testing::Message() << "box from " << low.transpose() << " to " << high.transpose());
      const auto [first, last] = fan.within_or_behind(box(low, high));
      for (std::size_t i = 0; i < points.size(); ++i) {
        if (i >= first && i < last) continue;
        ASSERT_FALSE(is_within_or_behind(points[i], low, high)) << points[i].transpose();
      }
    }
  }
}

TEST(SightFan, holds_little_else_for_a_small_box) {
  std::vector<Vector3d> points = points_all_around();
  const SightFan fan(points, kSensor, Vector3d::UnitZ(), Vector3d::UnitX());
  const auto [first, last] = fan.within_or_behind(box({2.0, -0.5, 0.9}, {2.1, 0.5, 1.0}));
  EXPECT_LT(last - first, points.size() / 10);
}

TEST(SightFan, keeps_all_points) {
  std::vector<Vector3d> points = points_all_around();
  std::vector<Vector3d> sorted = points;
  const SightFan fan(sorted, kSensor, Vector3d::UnitZ(), Vector3d::UnitX());
  const auto less = [](const Vector3d& a, const Vector3d& b) {
    return std::lexicographical_compare(a.begin(), a.end(), b.begin(), b.end());
  };
  std::sort(points.begin(), points.end(), less);
  std::sort(sorted.begin(), sorted.end(), less);
  EXPECT_EQ(points, sorted);
}

TEST(SightFan, of_no_points_is_empty) {
  std::vector<Vector3d> none;
  const SightFan fan(none, kSensor, Vector3d::UnitZ(), Vector3d::UnitX());
  EXPECT_EQ(fan.within_or_behind(box({1, 0, 0}, {2, 1, 1})), std::pair(std::size_t{0}, std::size_t{0}));
}

}  // namespace
}  // namespace stairway::detect
