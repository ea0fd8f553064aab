// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "detector/railing.hpp"

#include <gtest/gtest.h>

#include "detector/flight_frame.hpp"
#include "tests/detector/part_fixtures.hpp"

namespace stairway::detect {
namespace {

constexpr int kLast = 7;
constexpr Interval kSides{-0.6, 0.6};

StairModel straight() { return test::make_model(0.17, 0.29, 0.4); }

StairModel spiral(double turn_rad) {
  StairModel model = test::make_model(0.19, 0.25, 1.0);
  model.turn_rad = turn_rad;
  return model;
}

/// Points on the surface of a round bar.
void add_bar(scan::PointCloud& cloud, const Eigen::Vector3d& from, const Eigen::Vector3d& to, double radius_m) {
  const Eigen::Vector3d axis = (to - from).normalized();
  const Eigen::Vector3d one = axis.unitOrthogonal();
  const Eigen::Vector3d other = axis.cross(one);
  const int rings = std::max(2, static_cast<int>((to - from).norm() / 0.02));
  const int around = std::max(8, static_cast<int>(2.0 * M_PI * radius_m / 0.02));
  for (int ring = 0; ring <= rings; ++ring)
    for (int k = 0; k < around; ++k) {
      const double angle = 2.0 * M_PI * k / around;
      cloud.points.push_back(
          (from + (to - from) * ring / rings + radius_m * (std::cos(angle) * one + std::sin(angle) * other))
              .cast<float>());
    }
}

/// Above the nosing line at a real step number.
Eigen::Vector3d place(const StairModel& model, double number, double side_m, double above_m) {
  return model.step(number).from_step({.v = side_m, .z = above_m});
}

void add_handrail(scan::PointCloud& cloud, const StairModel& model, double side_m, double above_m = 0.85) {
  for (int number = 0; number < kLast; ++number)
    add_bar(cloud, place(model, number, side_m, above_m), place(model, number + 1, side_m, above_m), 0.022);
}

void add_posts(scan::PointCloud& cloud, const StairModel& model, double side_m, double height_m, int count = kLast) {
  for (int number = 0; number < count; ++number) {
    const Eigen::Vector3d foot = place(model, number + 0.5, side_m, -0.5 * model.height_m);
    add_bar(cloud, foot, foot + Eigen::Vector3d(0, 0, height_m), 0.012);
  }
}

void add_wall(scan::PointCloud& cloud, const StairModel& model, double side_m, double height_m) {
  for (double number = -1.0; number < kLast + 1; number += 0.1)
    for (double above = -0.2; above < height_m; above += 0.02)
      cloud.points.push_back(place(model, number, side_m, above).cast<float>());
}

Railing look(const scan::PointCloud& cloud, const StairModel& model) {
  return find_railing(cloud, model, kSides, 0, kLast);
}

void expect_railing(const scan::PointCloud& cloud, const StairModel& model, bool left, bool right) {
  const Railing railing = look(cloud, model);
  EXPECT_EQ(railing.left, left);
  EXPECT_EQ(railing.right, right);
}

TEST(FlightFrame, finds_the_way_back_from_any_place_on_a_stairway) {
  for (const StairModel& model : {straight(), spiral(0.35), spiral(-0.35)})
    for (double number : {-1.0, 0.0, 2.5, 17.0}) {
      const FlightPoint p = to_flight(model, place(model, number, 0.3, 0.8));
      EXPECT_NEAR(p.step, number, 1e-9);
      EXPECT_NEAR(p.side_m, 0.3, 1e-9);
      EXPECT_NEAR(p.above_m, 0.8, 1e-9);
    }
}

TEST(Railing, is_seen_on_the_side_where_it_stands) {
  for (const StairModel& model : {straight(), spiral(0.35), spiral(-0.35)}) {
    scan::PointCloud cloud;
    expect_railing(cloud, model, false, false);
    add_handrail(cloud, model, 0.56);
    add_posts(cloud, model, 0.56, 0.9);
    expect_railing(cloud, model, true, false);
    add_handrail(cloud, model, -0.65);
    expect_railing(cloud, model, true, true);
  }
}

TEST(Railing, may_be_a_handrail_on_a_wall) {
  scan::PointCloud cloud;
  add_wall(cloud, straight(), -0.65, 2.0);
  expect_railing(cloud, straight(), false, false);
  add_handrail(cloud, straight(), -0.57);
  expect_railing(cloud, straight(), false, true);
}

TEST(Railing, may_be_balusters_whose_handrail_is_out_of_sight) {
  scan::PointCloud cloud;
  add_posts(cloud, straight(), 0.62, 0.9);
  expect_railing(cloud, straight(), true, false);
}

TEST(Railing, is_no_wall_and_no_parapet) {
  scan::PointCloud cloud;
  add_wall(cloud, straight(), 0.62, 2.0);
  add_wall(cloud, straight(), -0.62, 0.9);
  expect_railing(cloud, straight(), false, false);
}

TEST(Railing, is_no_person_no_column_and_no_row_of_low_posts) {
  scan::PointCloud cloud;
  const Eigen::Vector3d foot = place(straight(), 2.0, 0.7, -0.3);
  add_bar(cloud, foot, foot + Eigen::Vector3d(0, 0, 1.8), 0.2);
  add_posts(cloud, straight(), 0.6, 0.9, 2);
  add_posts(cloud, straight(), -0.6, 0.5);
  expect_railing(cloud, straight(), false, false);
}

TEST(Railing, is_no_bar_of_another_slope_and_none_far_aside) {
  scan::PointCloud cloud;
  const StairModel model = straight();
  const Eigen::Vector3d begin = place(model, 0, 0.6, 0.9);
  add_bar(cloud, begin, begin - 2.0 * model.descent, 0.022);
  add_handrail(cloud, model, -0.9);
  expect_railing(cloud, model, false, false);
}

TEST(Railing, is_told_with_its_place) {
  for (const StairModel& model : {straight(), spiral(-0.35)}) {
    scan::PointCloud cloud;
    add_wall(cloud, model, 0.7, 1.5);
    for (int number = 0; number <= kLast; ++number)
      for (double side = -0.6; side <= 0.6; side += 0.02)
        for (double below = 0.0; below < 0.15; below += 0.02)
          cloud.points.push_back(model.step(number).from_step({.v = side, .z = -below}).cast<float>());
    add_handrail(cloud, model, -0.56);
    add_posts(cloud, model, -0.56, 0.9);
    const Railing railing = look(cloud, model);
    ASSERT_TRUE(railing.right);
    EXPECT_NEAR(railing.right_side_m, -0.56, 0.02);
  }
}

TEST(Railing, is_not_looked_for_when_switched_off) {
  scan::PointCloud cloud;
  add_handrail(cloud, straight(), 0.56);
  RailingOptions options;
  options.enabled = false;
  EXPECT_FALSE(find_railing(cloud, straight(), kSides, 0, kLast, options).left);
}

}  // namespace
}  // namespace stairway::detect
