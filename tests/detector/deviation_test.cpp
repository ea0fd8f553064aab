// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "detector/deviation.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "tests/detector/part_fixtures.hpp"

namespace stairway::detect {
namespace {

const StairModel kModel = test::make_model(0.17, 0.29);

StairPart moved(StairPart part, const Eigen::Vector3d& by) {
  for (Eigen::Vector3d* p :
       {&part.centroid, &part.top, &part.bottom, &part.front, &part.back, &part.end_a, &part.end_b})
    *p += by;
  return part;
}

void expect(const Deviation& off, double depth, double height, double direction) {
  EXPECT_NEAR(off.depth_m, depth, 1e-12);
  EXPECT_NEAR(off.height_m, height, 1e-12);
  EXPECT_NEAR(off.direction_rad, direction, 1e-7);
}

TEST(Deviation, of_parts_in_their_place_is_zero) {
  for (const View view : {View::FromBelow, View::FromAbove}) {
    for (int number = -2; number <= 3; ++number) {
      expect(deviation(kModel, number, test::riser_of(kModel, number), view), 0, 0, 0);
      expect(deviation(kModel, number, test::tread_of(kModel, number), view), 0, 0, 0);
    }
  }
}

TEST(Deviation, of_a_riser_follows_equations_5_8_11_and_13) {
  const StairPart riser = test::riser_of(kModel, 2);
  expect(deviation(kModel, 2, moved(riser, {0.02, 0, 0}), View::FromBelow), 0.02, 0, 0);
  expect(deviation(kModel, 2, moved(riser, {0, 0, 0.03}), View::FromBelow), 0, 0.03, 0);
  // Half hidden from below: from below the top still has to fit, from above nothing sticks out.
  StairPart cut = test::riser_of(kModel, 2, 1.2, 0.08);
  expect(deviation(kModel, 2, cut, View::FromBelow), 0, 0, 0);
  cut.top.z() -= 0.02;
  expect(deviation(kModel, 2, cut, View::FromBelow), 0, 0.02, 0);
  expect(deviation(kModel, 2, cut, View::FromAbove), 0, 0, 0);
  cut.top.z() += 0.05;
  expect(deviation(kModel, 2, cut, View::FromAbove), 0, 0.03, 0);
}

TEST(Deviation, of_a_turned_riser_is_the_angle_whichever_way_its_normal_points) {
  StairPart riser = test::riser_of(kModel, 1);
  riser.facing = Eigen::AngleAxisd(0.2, Eigen::Vector3d::UnitZ()) * riser.facing;
  EXPECT_NEAR(deviation(kModel, 1, riser, View::FromBelow).direction_rad, 0.2, 1e-9);
  riser.facing = -riser.facing;
  EXPECT_NEAR(deviation(kModel, 1, riser, View::FromBelow).direction_rad, 0.2, 1e-9);
}

TEST(Deviation, of_a_tread_follows_equations_16_17_and_19) {
  const StairPart tread = test::tread_of(kModel, 1);
  expect(deviation(kModel, 1, moved(tread, {0, 0, -0.01}), View::FromBelow), 0, 0.01, 0);
  // Moved along s, one edge sticks out of the model by as much.
  expect(deviation(kModel, 1, moved(tread, {-0.02, 0, 0}), View::FromBelow), 0.02, 0, 0);
  expect(deviation(kModel, 1, moved(tread, {0.02, 0, 0}), View::FromBelow), 0.02, 0, 0);
  // A tread whose front is hidden sticks out nowhere; seen from above its front is taken for the true one.
  StairPart back_half = tread;
  back_half.front += Eigen::Vector3d(0.1, 0, 0);
  expect(deviation(kModel, 1, back_half, View::FromBelow), 0, 0, 0);
  expect(deviation(kModel, 1, back_half, View::FromAbove), 0.1, 0, 0);
}

TEST(Deviation, of_an_underside_allows_for_the_thickness_of_the_tread) {
  StairModel model = kModel;
  model.tread_thickness_m = 0.04;
  StairPart underside = moved(test::tread_of(model, 4), {0, 0, -0.04});
  underside.from_below = true;
  expect(deviation(model, 4, underside, View::FromBelow), 0, 0, 0);
}

}  // namespace
}  // namespace stairway::detect
