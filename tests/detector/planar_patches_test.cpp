// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "detector/planar_patches.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>

#include "tests/detector/part_fixtures.hpp"

namespace stairway::detect {
namespace {

constexpr double kVoxel_m = 0.01;

SurfaceElements elements_of(const scan::PointCloud& cloud) { return surface_elements(cloud, kVoxel_m, {}, {}); }

scan::PointCloud with_noise(scan::PointCloud cloud, float sigma_m) {
  std::mt19937 engine(11);
  std::normal_distribution<float> noise(0.0F, sigma_m);
  for (Eigen::Vector3f& p : cloud.points) p += Eigen::Vector3f(noise(engine), noise(engine), noise(engine));
  return cloud;
}

scan::PointCloud floor_of_2_m() {
  scan::PointCloud cloud;
  test::add_rectangle(cloud, {0, 0, 0}, {2, 0, 0}, {0, 2, 0}, 0.012);
  return with_noise(std::move(cloud), 0.008F);
}

// Treads of 1 m by 0.3 m and the risers between them.
scan::PointCloud steps() {
  scan::PointCloud cloud;
  for (int i = 0; i < 4; ++i) {
    const double u = 0.3 * i;
    const double z = 0.17 * i;
    test::add_rectangle(cloud, {u, 0, z}, {0.3, 0, 0}, {0, 1, 0}, 0.01);
    test::add_rectangle(cloud, {u + 0.3, 0, z}, {0, 0, 0.17}, {0, 1, 0}, 0.01);
  }
  return with_noise(std::move(cloud), 0.004F);
}

std::size_t points_in_patches(const SurfaceElements& elements) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < elements.runs.size(); ++i)
    if (elements.weights[i] > 1) count += elements.runs[i].last - elements.runs[i].first;
  return count;
}

TEST(PlanarPatches, hold_most_of_a_floor) {
  const scan::PointCloud cloud = floor_of_2_m();
  const SurfaceElements elements = elements_of(cloud);
  EXPECT_GT(points_in_patches(elements), cloud.points.size() / 2);
  EXPECT_LT(elements.cloud.points.size(), cloud.points.size() / 2);
}

TEST(PlanarPatches, leave_no_point_out_and_take_none_twice) {
  const scan::PointCloud cloud = steps();
  const SurfaceElements elements = elements_of(cloud);
  std::vector<std::uint32_t> members = elements.members;
  std::sort(members.begin(), members.end());
  ASSERT_EQ(members.size(), cloud.points.size());
  for (std::size_t i = 0; i < members.size(); ++i) ASSERT_EQ(members[i], i);
  std::uint32_t end = 0;
  for (const SurfaceElements::Run& run : elements.runs) {
    EXPECT_EQ(run.first, end);
    EXPECT_GT(run.last, run.first);
    end = run.last;
  }
  EXPECT_EQ(end, members.size());
}

TEST(PlanarPatches, have_the_normal_of_their_plane_towards_the_sensor) {
  for (const float above : {1.0F, -1.0F}) {
    scan::PointCloud cloud = floor_of_2_m();
    cloud.sensor_origin = Eigen::Vector3f(1, 1, above);
    const SurfaceElements elements = elements_of(cloud);
    for (std::size_t i = 0; i < elements.runs.size(); ++i) {
      if (elements.weights[i] == 1) continue;
      EXPECT_GT(above * elements.surface.normals[i].z(), 0.99F);
    }
  }
}

TEST(PlanarPatches, do_not_take_a_column_for_planes) {
  scan::PointCloud column;
  for (int i = 0; i < 60; ++i)
    for (int k = 0; k < 150; ++k) {
      const double angle = 2.0 * std::numbers::pi * i / 60.0;
      column.points.emplace_back(0.2 * std::cos(angle), 0.2 * std::sin(angle), 0.01 * k);
    }
  EXPECT_EQ(points_in_patches(elements_of(with_noise(column, 0.003F))), 0U);
}

TEST(PlanarPatches, do_not_bridge_the_edge_of_a_step) {
  const scan::PointCloud cloud = steps();
  const SurfaceElements elements = elements_of(cloud);
  for (std::size_t i = 0; i < elements.runs.size(); ++i) {
    if (elements.weights[i] == 1) continue;
    const float upward = std::abs(elements.surface.normals[i].z());
    EXPECT_TRUE(upward < 0.1F || upward > 0.99F) << upward;
  }
}

TEST(PlanarPatches, grow_into_the_regions_that_points_grow_into) {
  const scan::PointCloud cloud = steps();
  std::vector<PlaneRegion> by_patches = grow_regions(cloud, elements_of(cloud), {});
  std::vector<PlaneRegion> by_points = grow_regions(cloud, estimate_normals(cloud));
  const auto larger = [](const PlaneRegion& a, const PlaneRegion& b) { return a.points.size() > b.points.size(); };
  std::sort(by_patches.begin(), by_patches.end(), larger);
  std::sort(by_points.begin(), by_points.end(), larger);
  constexpr std::size_t kFaces = 8;
  ASSERT_GE(by_patches.size(), kFaces);
  ASSERT_GE(by_points.size(), kFaces);
  for (std::size_t i = 0; i < kFaces; ++i) {
    const auto same = std::find_if(by_points.begin(), by_points.begin() + kFaces, [&](const PlaneRegion& other) {
      return (other.axes.centroid - by_patches[i].axes.centroid).norm() < 0.02 &&
             std::abs(other.axes.normal().dot(by_patches[i].axes.normal())) > 0.99;
    });
    EXPECT_NE(same, by_points.begin() + kFaces) << by_patches[i].axes.centroid.transpose();
  }
}

TEST(PlanarPatches, do_not_depend_on_the_order_of_the_points) {
  const scan::PointCloud cloud = floor_of_2_m();
  scan::PointCloud shuffled = cloud;
  std::mt19937 engine(5);
  std::shuffle(shuffled.points.begin(), shuffled.points.end(), engine);
  const SurfaceElements a = elements_of(cloud);
  const SurfaceElements b = elements_of(shuffled);
  ASSERT_EQ(a.cloud.points.size(), b.cloud.points.size());
  EXPECT_EQ(a.weights, b.weights);
  for (std::size_t i = 0; i < a.cloud.points.size(); ++i) {
    EXPECT_LT((a.cloud.points[i] - b.cloud.points[i]).norm(), 1e-5F);
    EXPECT_LT((a.surface.normals[i] - b.surface.normals[i]).norm(), 1e-3F);
  }
}

TEST(PlanarPatches, leave_out_what_is_not_finite_and_survive_empty_clouds) {
  scan::PointCloud cloud = floor_of_2_m();
  const std::size_t finite = cloud.points.size();
  cloud.points.insert(cloud.points.begin(), 5, Eigen::Vector3f::Constant(std::numeric_limits<float>::quiet_NaN()));
  EXPECT_EQ(elements_of(cloud).members.size(), finite);
  EXPECT_TRUE(elements_of({}).runs.empty());
  EXPECT_TRUE(grow_regions({}, elements_of({}), {}).empty());
}

TEST(PlanarPatches, drop_what_is_seen_from_within_with_all_that_belongs_to_it) {
  scan::PointCloud cloud = floor_of_2_m();
  cloud.sensor_origin = Eigen::Vector3f(-1, 1, 0.02F);
  SurfaceElements elements = elements_of(cloud);
  elements.drop_ghosts(std::numbers::pi / 18);
  EXPECT_LT(elements.runs.size(), elements_of(cloud).runs.size() / 10);
  EXPECT_EQ(elements.weights.size(), elements.runs.size());
  EXPECT_EQ(elements.cloud.points.size(), elements.runs.size());
  for (std::size_t i = 0; i < elements.runs.size(); ++i) {
    const Eigen::Vector3f& first = cloud.points[elements.members[elements.runs[i].first]];
    EXPECT_LT((first - elements.cloud.points[i]).norm(), 0.3F);
  }
}

TEST(PlanarPatches, say_which_option_is_wrong) {
  EXPECT_EQ(PatchOptions{}.problem(), "");
  for (const PatchOptions& wrong :
       {PatchOptions{.edge_m = 0.0}, PatchOptions{.min_points = 2}, PatchOptions{.max_thickness_m = 0.0}})
    EXPECT_NE(wrong.problem(), "");
}

TEST(WeightedGrowing, counts_points_for_what_they_stand_for) {
  scan::PointCloud cloud;
  test::add_rectangle(cloud, {0, 0, 0}, {0.5, 0, 0}, {0, 0.5, 0}, 0.13);
  const SurfaceNormals surface{std::vector<Eigen::Vector3f>(cloud.points.size(), Eigen::Vector3f::UnitZ()),
                               std::vector<float>(cloud.points.size(), 0.01F)};
  const std::vector<std::uint32_t> light(cloud.points.size(), 1);
  const std::vector<std::uint32_t> heavy(cloud.points.size(), 10);
  ASSERT_LT(cloud.points.size(), 30U);
  EXPECT_TRUE(grow_point_sets(cloud, surface, light, {}).empty());
  ASSERT_EQ(grow_point_sets(cloud, surface, heavy, {}).size(), 1U);
  EXPECT_EQ(grow_point_sets(cloud, surface, heavy, {}).front().size(), cloud.points.size());
}

}  // namespace
}  // namespace stairway::detect
