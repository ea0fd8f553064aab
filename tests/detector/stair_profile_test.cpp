// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "detector/stair_profile.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace stairway::detect {
namespace {

using Kind = VisibleFace::Kind;

StairProfileShape three_steps() {
  StairProfileShape shape;
  for (int i = 0; i < 3; ++i) shape.nosings.emplace_back(0.3 * i, 0.2 * i);
  shape.step_height_m = 0.2;
  return shape;
}

const VisibleFace& at(const std::vector<VisibleFace>& faces, double elevation_rad) {
  return *std::find_if(faces.begin(), faces.end(),
                       [&](const VisibleFace& face) { return elevation_rad <= face.end_rad; });
}

double towards(const Eigen::Vector2d& sensor, double u, double z) { return std::atan2(z - sensor.y(), u - sensor.x()); }

TEST(Elevation, near_another_has_its_own_sine_and_cosine) {
  for (const double at : {-3.0, -1.2, 0.0, 0.4, 1.5707, 3.1}) {
    for (const double turn : {-2.0, -0.11, -0.09, -1e-3, 0.0, 0.03, 0.099, 0.5}) {
      SCOPED_TRACE(::testing::Message() << at << " turned by " << turn);
      const Elevation near = Elevation(at).near_by(at + turn);
      EXPECT_EQ(near.rad, at + turn);
      EXPECT_NEAR(near.cosine, std::cos(at + turn), 3e-9);
      EXPECT_NEAR(near.sine, std::sin(at + turn), 3e-9);
    }
  }
}

TEST(StairProfile, fills_all_elevations_without_gaps) {
  for (const bool open : {false, true}) {
    for (const Eigen::Vector2d& sensor : {Eigen::Vector2d(-2.0, 0.3), Eigen::Vector2d(-1.0, -0.1),
                                          Eigen::Vector2d(1.5, 1.0), Eigen::Vector2d(0.2, 0.9)}) {
      StairProfileShape shape = three_steps();
      shape.open_risers = open;
      shape.overhang_m = open ? 0.0 : 0.02;
      const std::vector<VisibleFace> faces = visible_faces(shape, sensor);
      ASSERT_FALSE(faces.empty());
      EXPECT_DOUBLE_EQ(faces.front().begin_rad, -std::numbers::pi);
      EXPECT_DOUBLE_EQ(faces.back().end_rad, std::numbers::pi);
      for (std::size_t i = 1; i < faces.size(); ++i) EXPECT_NEAR(faces[i].begin_rad, faces[i - 1].end_rad, 1e-8);
    }
  }
}

TEST(StairProfile, shows_risers_and_the_treads_below_the_sensor) {
  const Eigen::Vector2d sensor(-2.0, 0.1);  // above the first tread, below the second
  const std::vector<VisibleFace> faces = visible_faces(three_steps(), sensor);
  const VisibleFace& first = at(faces, towards(sensor, 0.0, -0.1));
  EXPECT_EQ(first.kind, Kind::Upright);
  EXPECT_NEAR(first.place_m, 2.0, 1e-12);
  EXPECT_EQ(first.step, 0);
  const VisibleFace& tread = at(faces, towards(sensor, 0.15, 0.0));
  EXPECT_EQ(tread.kind, Kind::Level);
  EXPECT_NEAR(tread.distance_m(towards(sensor, 0.15, 0.0)), std::hypot(2.15, 0.1), 1e-9);
  EXPECT_EQ(at(faces, towards(sensor, 0.3, 0.15)).step, 1);
  EXPECT_EQ(at(faces, towards(sensor, 0.45, 0.201)).kind, Kind::Upright) << "the second tread is hidden from below";
  EXPECT_EQ(at(faces, towards(sensor, 0.6, 0.41)).kind, Kind::Beyond);
  EXPECT_EQ(at(faces, towards(sensor, 0.0, -0.3)).kind, Kind::Unknown) << "nobody knows where the flight begins";
}

TEST(StairProfile, sets_lips_before_the_risers) {
  StairProfileShape shape = three_steps();
  shape.overhang_m = 0.03;
  shape.thickness_m = 0.05;
  const Eigen::Vector2d sensor(-2.0, 0.1);
  const std::vector<VisibleFace> faces = visible_faces(shape, sensor);
  EXPECT_NEAR(at(faces, towards(sensor, 0.0, -0.02)).place_m, 2.0, 1e-12);
  EXPECT_NEAR(at(faces, towards(sensor, 0.03, -0.1)).place_m, 2.03, 1e-12);
}

TEST(StairProfile, lets_one_look_through_open_risers_and_at_undersides) {
  StairProfileShape shape = three_steps();
  shape.open_risers = true;
  const Eigen::Vector2d sensor(-1.0, -0.3);
  const std::vector<VisibleFace> faces = visible_faces(shape, sensor);
  const VisibleFace& board = at(faces, towards(sensor, 0.0, -0.02));
  EXPECT_EQ(board.kind, Kind::Upright);
  const VisibleFace& underside = at(faces, towards(sensor, 0.1, -0.04));
  EXPECT_EQ(underside.kind, Kind::Level);
  EXPECT_NEAR(underside.place_m, 0.26, 1e-12);
  EXPECT_EQ(at(faces, towards(sensor, 0.0, -0.3)).kind, Kind::Beyond);
  EXPECT_EQ(at(faces, towards(sensor, 0.4, 0.16)).kind, Kind::Level) << "the second one's";
}

TEST(StairProfile, shows_a_sensor_above_its_treads_alone) {
  StairProfileShape shape = three_steps();
  shape.last_tread_m = 100.0;
  shape.goes_on_below = true;
  const Eigen::Vector2d sensor(1.0, 1.0);
  const std::vector<VisibleFace> faces = visible_faces(shape, sensor);
  EXPECT_EQ(std::count_if(faces.begin(), faces.end(), [](const VisibleFace& f) { return f.kind == Kind::Level; }), 3);
  EXPECT_EQ(std::count_if(faces.begin(), faces.end(), [](const VisibleFace& f) { return f.kind == Kind::Upright; }), 0);
  EXPECT_EQ(at(faces, towards(sensor, -0.5, 0.0)).kind, Kind::Unknown) << "further steps";
}

}  // namespace
}  // namespace stairway::detect
