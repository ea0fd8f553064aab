// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "detector/robust_descent.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

namespace stairway::detect {
namespace {

constexpr double kKernel = 5.0;
constexpr double kReach = 1e-4;

NormalEquations knowing_nothing(int unknowns) {
  return {1e-12 * Eigen::MatrixXd::Identity(unknowns, unknowns), Eigen::VectorXd::Zero(unknowns)};
}

TEST(RobustDescent, weighs_residuals_less_the_larger_they_are) {
  EXPECT_EQ(biweight(0.0, kKernel), 1.0);
  EXPECT_LT(biweight(3.0, kKernel), biweight(-1.0, kKernel));
  EXPECT_EQ(biweight(kKernel, kKernel), 0.0);
  EXPECT_EQ(biweight(-100.0, kKernel), 0.0);
}

TEST(RobustDescent, gains_what_residuals_shrink_by_but_from_those_that_nobody_knows) {
  const double unknown = std::numeric_limits<double>::quiet_NaN();
  const Eigen::Vector3d before(1.0, unknown, 100.0);
  EXPECT_GT(robust_gain(Eigen::Vector3d(0.5, 0.0, 100.0), before, kKernel), 0.0);
  EXPECT_LT(robust_gain(Eigen::Vector3d(1.5, 0.0, 100.0), before, kKernel), 0.0);
  EXPECT_EQ(robust_gain(Eigen::Vector3d(1.0, 7.0, 90.0), before, kKernel), 0.0) << "wild before and after";
  EXPECT_NEAR(robust_gain(Eigen::Vector3d(0.0, unknown, 100.0), before, 1000.0), 1.0, 1e-3) << "chi^2 when not wild";
}

TEST(RobustDescent, finds_the_mean_of_what_agrees) {
  // x is measured as 2 four times with sigma 1, and once as 60.
  const Eigen::VectorXd measured = (Eigen::VectorXd(5) << 2.0, 2.1, 1.9, 2.0, 60.0).finished();
  NormalEquations normal = knowing_nothing(1);
  add_rows(-measured, Eigen::MatrixXd::Ones(5, 1), kKernel, kReach, normal);
  double x = 0.0;
  damped_descent(normal, [&](const Eigen::VectorXd& change) {
    x = change[0];
    return true;
  });
  EXPECT_NEAR(x, 2.0, 0.01);
  EXPECT_GT(normal.sigmas()[0], 0.5) << "four measurements";
  EXPECT_LT(normal.sigmas()[0], 1.0);
}

TEST(RobustDescent, leaves_out_rows_that_jump_or_are_not_known) {
  const Eigen::Vector3d r(0.5, 0.5, std::numeric_limits<double>::quiet_NaN());
  const Eigen::Vector3d slopes(1.0, 1e6, 1.0);
  NormalEquations normal = knowing_nothing(1);
  add_rows(r, slopes, kKernel, kReach, normal);
  EXPECT_NEAR(normal.information(0, 0), biweight(0.5, kKernel), 1e-9);
}

TEST(RobustDescent, shortens_its_steps_until_one_is_taken_or_gives_up) {
  NormalEquations normal = knowing_nothing(1);
  add_rows(Eigen::VectorXd::Constant(1, 2.0), Eigen::MatrixXd::Ones(1, 1), kKernel, kReach, normal);
  std::vector<double> tried;
  damped_descent(normal, [&](const Eigen::VectorXd& change) {
    tried.push_back(change[0]);
    return false;
  });
  ASSERT_GT(tried.size(), 2U);
  EXPECT_NEAR(tried.front(), -2.0, 1e-6);
  for (std::size_t i = 1; i < tried.size(); ++i) EXPECT_LT(std::abs(tried[i]), std::abs(tried[i - 1]));
}

}  // namespace
}  // namespace stairway::detect
