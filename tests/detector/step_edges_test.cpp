// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "detector/step_edges.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace stairway::detect {
namespace {

constexpr double kFront_m = 6.0;
constexpr double kWall_m = 9.0;
constexpr double kTop_m = 0.7;
constexpr double kSensor_m = 0.5;
constexpr double kBetweenBeams_rad = 0.25 * M_PI / 180.0;

// A front as wide as it is far, seen by beams on a square grid that is rolled about the view and shifted upwards.
scan::PointCloud front_before_wall(double roll_rad, double shift_rad) {
  scan::PointCloud cloud;
  cloud.sensor_origin = Eigen::Vector3f(0.0F, 0.0F, static_cast<float>(kSensor_m));
  for (int row = -30; row <= 30; ++row) {
    for (int column = -30; column <= 30; ++column) {
      const double a = column * kBetweenBeams_rad;
      const double b = row * kBetweenBeams_rad;
      const Eigen::Vector3d way(1.0, std::tan(a * std::cos(roll_rad) - b * std::sin(roll_rad)),
                                std::tan(a * std::sin(roll_rad) + b * std::cos(roll_rad) + shift_rad));
      const bool on_front = kSensor_m + kFront_m * way.z() < kTop_m;
      const Eigen::Vector3d point = Eigen::Vector3d(0, 0, kSensor_m) + (on_front ? kFront_m : kWall_m) * way;
      cloud.points.push_back(point.cast<float>());
    }
  }
  return cloud;
}

NosingSight measured_nosing(double roll_rad, double shift_rad) {
  const StairModel model{
      .height_m = 0.17, .depth_m = 0.29, .descent = -Eigen::Vector3d::UnitX(), .nosing = {kFront_m, 0.0, kTop_m}};
  const Interval sides{-0.6, 0.6};
  const StairCorridor corridor(front_before_wall(roll_rad, shift_rad), model, sides);
  const StepMeasurementOptions options;
  const std::optional<NosingSight> nosing = nosing_over_front(StepView(corridor, model, sides, 0, options), 0.0);
  EXPECT_TRUE(nosing);
  return nosing.value_or(NosingSight{});
}

TEST(NosingOverFront, is_known_no_better_than_beams_in_rows_along_it_tell) {
  for (const double share : {0.0, 0.3, 0.6, 0.9}) {
    SCOPED_TRACE(share);
    const NosingSight nosing = measured_nosing(0.0, share * kBetweenBeams_rad);
    EXPECT_NEAR(nosing.sigma_m, kFront_m * kBetweenBeams_rad / std::sqrt(12.0), 0.001);
    EXPECT_LT(std::abs(nosing.at.z), 2.0 * nosing.sigma_m);
  }
}

TEST(NosingOverFront, is_known_well_where_rows_of_beams_cross_it) {
  for (const double share : {0.0, 0.3, 0.6, 0.9}) {
    SCOPED_TRACE(share);
    const NosingSight nosing = measured_nosing(0.35, share * kBetweenBeams_rad);
    EXPECT_LT(nosing.sigma_m, 0.003);
    EXPECT_LT(std::abs(nosing.at.z), 3.0 * nosing.sigma_m);
  }
}

}  // namespace
}  // namespace stairway::detect
