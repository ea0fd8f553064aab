// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "tools/sim/angles.hpp"
#include "tools/sim/depth_camera.hpp"
#include "tools/sim/helmet_scene.hpp"

namespace stairway::sim {
namespace {

using Eigen::Vector3d;

DepthCameraOptions small_camera() {
  DepthCameraOptions options;
  options.intrinsics = {.width_px = 80, .height_px = 60, .focal_px = 72.5};
  return options;
}

DepthCameraOptions perfect_camera() {
  DepthCameraOptions options = small_camera();
  options.noise_scale = options.inverse_depth_step = options.edge_noise_px = options.baseline_m = 0.0;
  return options;
}

// A wall across the optical axis, `distance_m` ahead of a camera at the origin that looks along x.
Scene wall(double distance_m, double turned_rad = 0.0) {
  Scene scene;
  Mesh mesh;
  mesh.add_box({distance_m + 0.05, 0.0}, -20.0, {0.1, 40.0, 40.0}, 0.0);
  if (turned_rad == 0.0) {
    scene.mesh = mesh;
  } else {
    Eigen::Isometry3d T{Eigen::Translation3d{distance_m, 0.0, 0.0}};
    T.rotate(Eigen::AngleAxisd{turned_rad, Vector3d::UnitZ()});
    T.translate(Vector3d{-distance_m, 0.0, 0.0});
    scene.mesh.append(mesh, T);
  }
  return scene;
}

CameraPose level_pose() { return {.position = Vector3d::Zero(), .pitch_down_rad = 0.0}; }

std::size_t missing(const DepthImage& image) {
  return static_cast<std::size_t>(std::count(image.depth_m.begin(), image.depth_m.end(), 0.0F));
}

double deviation_from(const DepthImage& image, double depth_m) {
  double sum = 0.0;
  for (const float depth : image.depth_m) sum += (depth - depth_m) * (depth - depth_m);
  return std::sqrt(sum / static_cast<double>(image.depth_m.size()));
}

TEST(SimDepthCamera, projects_a_ray_back_to_its_pixel) {
  const CameraIntrinsics intrinsics;
  for (const auto& [column, row] : {std::pair{0.0, 0.0}, {639.0, 479.0}, {319.5, 239.5}, {12.25, 400.5}}) {
    const auto pixel = intrinsics.pixel(2.7 * intrinsics.ray(column, row));
    ASSERT_TRUE(pixel);
    EXPECT_NEAR(pixel->x(), column, 1e-9);
    EXPECT_NEAR(pixel->y(), row, 1e-9);
  }
  EXPECT_FALSE(intrinsics.pixel({0.0, 0.0, -1.0}));
  EXPECT_FALSE(intrinsics.pixel({1.0, 0.0, 1.0}));
}

TEST(SimDepthCamera, looks_along_x_and_down) {
  const CameraPose pose{.position = {0.5, 0.0, 1.7}, .yaw_rad = 0.3, .pitch_down_rad = 0.4};
  const Vector3d axis = pose.T_scene_camera().linear() * Vector3d::UnitZ();
  EXPECT_NEAR((axis - Vector3d{std::cos(0.4) * std::cos(0.3), std::cos(0.4) * std::sin(0.3), -std::sin(0.4)}).norm(),
              0.0, 1e-12);
  const Vector3d right = level_pose().T_scene_camera().linear() * Vector3d::UnitX();
  EXPECT_NEAR((right + Vector3d::UnitY()).norm(), 0.0, 1e-12);
}

TEST(SimDepthCamera, a_perfect_one_puts_every_point_where_it_is) {
  const DepthCameraOptions options = perfect_camera();
  const CameraPose pose{.position = {0.0, 0.0, 1.7}, .yaw_rad = 0.2, .pitch_down_rad = 0.1, .roll_rad = 0.05};
  const auto cloud = to_cloud(simulate_depth_image(wall(2.0), pose, options, 1), options.intrinsics, pose);
  ASSERT_EQ(cloud.points.size(), 80U * 60U);
  for (const auto& p : cloud.points) ASSERT_NEAR(p.x(), 2.0, 1e-4);
  ASSERT_TRUE(cloud.sensor_origin);
  EXPECT_NEAR(cloud.sensor_origin->z(), 1.7, 1e-6);
}

TEST(SimDepthCamera, noise_grows_with_the_square_of_the_distance_and_with_the_slant) {
  EXPECT_NEAR(axial_noise_m(0.4, 0.0), 0.0012, 1e-12);
  EXPECT_NEAR(axial_noise_m(3.4, 0.0), 0.0012 + 9 * 0.0019, 1e-12);
  EXPECT_GT(axial_noise_m(1.0, 1.2), 1.5 * axial_noise_m(1.0, 0.0));
  DepthCameraOptions options = perfect_camera();
  options.noise_scale = 1.0;
  for (const double distance : {1.0, 2.0, 4.0}) {
    SCOPED_TRACE(distance);
    const double measured = deviation_from(simulate_depth_image(wall(distance), level_pose(), options, 1), distance);
    EXPECT_NEAR(measured, axial_noise_m(distance, 0.0), 0.06 * measured);
  }
}

TEST(SimDepthCamera, depths_come_in_steps_that_grow_with_the_square_of_the_distance) {
  DepthCameraOptions options = small_camera();
  for (const auto& [distance, step] : {std::pair{1.0, 0.00287}, {4.0, 16 * 0.00287}}) {
    SCOPED_TRACE(distance);
    auto depths = simulate_depth_image(wall(distance), level_pose(), options, 1).depth_m;
    std::sort(depths.begin(), depths.end());
    depths.erase(std::unique(depths.begin(), depths.end()), depths.end());
    ASSERT_GE(depths.size(), 3U);
    const auto middle = std::lower_bound(depths.begin() + 1, depths.end() - 1, static_cast<float>(distance));
    EXPECT_NEAR(*middle - *(middle - 1), step, 0.05 * step);
  }
}

TEST(SimDepthCamera, has_no_depth_beyond_its_range_or_where_it_looks_along_a_surface) {
  const DepthCameraOptions options = small_camera();
  EXPECT_EQ(missing(simulate_depth_image(wall(0.45), level_pose(), options, 1)), 80U * 60U);
  EXPECT_EQ(missing(simulate_depth_image(wall(5.0), level_pose(), options, 1)), 80U * 60U);
  EXPECT_EQ(missing(simulate_depth_image(wall(2.0), level_pose(), options, 1)), 0U);
  DepthCameraOptions strict = options;
  strict.max_incidence_rad = 0.9;
  EXPECT_EQ(missing(simulate_depth_image(wall(2.0, 0.4), level_pose(), options, 1)), 0U);
  EXPECT_GT(missing(simulate_depth_image(wall(2.0, 0.7), level_pose(), strict, 1)), 80U * 60U / 10U);
}

TEST(SimDepthCamera, sees_a_shadow_on_the_side_of_a_thing_that_its_projector_does_not_light) {
  Scene scene = wall(3.0);
  scene.mesh.add_box({1.5, 0.0}, -2.0, {0.1, 0.3, 4.0}, 0.0);
  DepthCameraOptions options = perfect_camera();
  options.intrinsics = {.width_px = 320, .height_px = 10, .focal_px = 290.0};
  EXPECT_EQ(missing(simulate_depth_image(scene, level_pose(), options, 1)), 0U);
  options.baseline_m = 0.075;
  const DepthImage image = simulate_depth_image(scene, level_pose(), options, 1);
  for (int row = 0; row < 10; ++row) {
    const auto begin = image.depth_m.begin() + 320 * row;
    const auto first = std::find(begin, begin + 320, 0.0F);
    const auto shade = std::count(begin, begin + 320, 0.0F);
    EXPECT_LT(first - begin, 160) << "left of the thing, for the projector is on its right";
    EXPECT_NEAR(static_cast<double>(shade), 290.0 * 0.075 * (1 / 1.45 - 1 / 3.0), 2.0);
  }
}

TEST(SimDepthCamera, a_wrong_gravity_tilts_the_cloud) {
  const DepthCameraOptions options = perfect_camera();
  CameraPose assumed = level_pose();
  assumed.pitch_down_rad = 0.02;
  const auto cloud = to_cloud(simulate_depth_image(wall(2.0), level_pose(), options, 1), options.intrinsics, assumed);
  const auto [low, high] = std::minmax_element(cloud.points.begin(), cloud.points.end(),
                                               [](const auto& a, const auto& b) { return a.z() < b.z(); });
  EXPECT_NEAR((high->x() - low->x()) / (high->z() - low->z()), std::tan(0.02), 1e-3);
}

TEST(SimDepthCamera, repeats_itself_and_differs_by_seed) {
  const Scene scene = wall(2.0);
  const auto first = simulate_depth_image(scene, level_pose(), small_camera(), 1).depth_m;
  EXPECT_EQ(first, simulate_depth_image(scene, level_pose(), small_camera(), 1).depth_m);
  EXPECT_NE(first, simulate_depth_image(scene, level_pose(), small_camera(), 2).depth_m);
}

TEST(SimDepthCamera, refuses_options_that_make_no_sense) {
  DepthCameraOptions options;
  options.max_depth_m = options.min_depth_m;
  EXPECT_NE(options.problem(), "");
  EXPECT_THROW(simulate_depth_image(wall(2.0), {}, options, 1), std::invalid_argument);
  options = {};
  options.intrinsics.width_px = 0;
  EXPECT_NE(options.problem(), "");
  options = {};
  options.noise_scale = NAN;
  EXPECT_NE(options.problem(), "");
}

TEST(SimHelmetScene, can_all_be_built_and_show_what_they_are_about) {
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    for (const auto subject : {HelmetSubject::Ascending, HelmetSubject::Descending, HelmetSubject::Nothing}) {
      SCOPED_TRACE(seed);
      const HelmetScene view = random_helmet_scene(seed, subject);
      ASSERT_EQ(view.scene.problem(), "");
      EXPECT_LT(std::abs(view.assumed.pitch_down_rad - view.pose.pitch_down_rad), 5 * kDegree);
      ASSERT_EQ(view.scene.stairs.empty(), subject == HelmetSubject::Nothing);
      if (view.scene.stairs.empty()) continue;
      EXPECT_EQ(view.scene.stairs[0].descending, subject == HelmetSubject::Descending);
      const auto seen = nosings_in_view(build_flight(view.scene.stairs[0]).truth, view.pose);
      EXPECT_GE(std::count(seen.begin(), seen.end(), true), 4);
    }
  }
}

TEST(SimHelmetScene, differ_by_seed_and_repeat_themselves) {
  const auto height = [](std::uint64_t seed) {
    return random_helmet_scene(seed, HelmetSubject::Ascending).scene.stairs[0].height_m;
  };
  EXPECT_EQ(height(3), height(3));
  EXPECT_NE(height(3), height(4));
}

}  // namespace
}  // namespace stairway::sim
