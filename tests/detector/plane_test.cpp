// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "detector/plane.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <random>

namespace stairway::detect {
namespace {

TEST(PointMoments, of_two_sets_add_up_to_those_of_their_union) {
  std::mt19937 engine(5);
  std::normal_distribution<float> place(0.0F, 1.0F);
  PointMoments whole(Eigen::Vector3d(100, 0, 0));
  PointMoments left(Eigen::Vector3d(101, 2, 0));
  PointMoments right(Eigen::Vector3d(-3, 0, 5));
  for (int i = 0; i < 500; ++i) {
    const Eigen::Vector3f p(100.0F + place(engine), place(engine), place(engine));
    whole.add(p);
    (i % 3 == 0 ? left : right).add(p);
  }
  left.add(right);
  EXPECT_EQ(left.count(), whole.count());
  EXPECT_LT((left.mean() - whole.mean()).norm(), 1e-9);
  EXPECT_LT((left.covariance() - whole.covariance()).norm(), 1e-7);
}

TEST(PrincipalAxes, of_a_tilted_rectangle_are_its_edges_and_normal) {
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix();
  PointMoments moments;
  for (int i = -20; i <= 20; ++i)
    for (int k = -5; k <= 5; ++k)
      moments.add((turn * Eigen::Vector3d(0.1 * i, 0.1 * k, 0) + Eigen::Vector3d(3, 4, 5)).cast<float>());
  const PrincipalAxes axes = principal_axes(moments);
  EXPECT_NEAR(std::abs(axes.axes.col(0).dot(turn.col(0))), 1.0, 1e-6);
  EXPECT_NEAR(std::abs(axes.axes.col(1).dot(turn.col(1))), 1.0, 1e-6);
  EXPECT_NEAR(std::abs(axes.normal().dot(turn.col(2))), 1.0, 1e-6);
  EXPECT_LT((axes.centroid - Eigen::Vector3d(3, 4, 5)).norm(), 1e-5);
  EXPECT_LT(axes.surface_variation(), 1e-6);
  EXPECT_GE(axes.variances[2], 0.0);
}

TEST(PrincipalAxes, of_fewer_than_three_points_are_those_of_the_frame) {
  PointMoments moments;
  moments.add(Eigen::Vector3f(1, 2, 3));
  EXPECT_EQ(principal_axes(moments).axes, Eigen::Matrix3d::Identity());
  EXPECT_EQ(principal_axes(PointMoments()).surface_variation(), 0.0);
}

}  // namespace
}  // namespace stairway::detect
