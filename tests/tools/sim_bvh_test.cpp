// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "tools/sim/bvh.hpp"
#include "tools/sim/random.hpp"
#include "tools/sim/random_scenes.hpp"
#include "tools/sim/scene.hpp"

namespace stairway::sim {
namespace {

using Eigen::Vector3d;

Vector3d random_direction(Random& random) {
  return Vector3d{random.normal(), random.normal(), random.normal()}.normalized();
}

// Every triangle, in double precision, by the plane and three half-planes instead of Moeller and Trumbore.
double range_by_brute_force(const Mesh& mesh, const Vector3d& origin, const Vector3d& direction) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const auto& triangle : mesh.triangles()) {
    const auto& [a, b, c] = triangle.corners;
    const Vector3d normal = (b - a).cross(c - a);
    const double range = normal.dot(a - origin) / normal.dot(direction);
    if (!(range > 0) || range >= nearest) continue;
    const Vector3d p = origin + range * direction;
    const bool is_inside = (b - a).cross(p - a).dot(normal) >= 0 && (c - b).cross(p - b).dot(normal) >= 0 &&
                           (a - c).cross(p - c).dot(normal) >= 0;
    if (is_inside) nearest = range;
  }
  return nearest;
}

// Rays that pass an edge within single precision may go either way.
void expect_same_as_brute_force(const Mesh& mesh, const Vector3d& origin, int rays, Random& random) {
  const Bvh bvh{mesh};
  int differing = 0;
  for (int i = 0; i < rays; ++i) {
    const Vector3d direction = random_direction(random);
    const Hit hit = bvh.cast(origin.cast<float>(), direction.cast<float>(), 100.0F);
    const double expected = range_by_brute_force(mesh, origin, direction);
    const bool is_same =
        std::isfinite(expected) ? std::abs(hit.range_m - expected) < 1e-4 * (1 + expected) : hit.surface == kNoSurface;
    if (!is_same) ++differing;
  }
  EXPECT_LE(differing, rays / 1000);
}

TEST(SimBvh, agrees_with_brute_force_in_furnished_rooms) {
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    SCOPED_TRACE(seed);
    Random random{seed};
    expect_same_as_brute_force(build_scene(random_room(seed)).mesh, {0.1, -0.05, 0.5}, 3000, random);
    expect_same_as_brute_force(build_scene(random_stair_scene(seed)).mesh, {0.0, 0.0, 0.5}, 3000, random);
  }
}

TEST(SimBvh, agrees_with_brute_force_in_a_cloud_of_loose_triangles) {
  Random random{7};
  Mesh mesh;
  for (int i = 0; i < 500; ++i) {
    const Vector3d a = 5 * random_direction(random) * random.uniform();
    mesh.add_polygon(std::array{a, Vector3d{a + random_direction(random)}, Vector3d{a + random_direction(random)}});
  }
  expect_same_as_brute_force(mesh, {0.2, 0.1, -0.3}, 5000, random);
}

TEST(SimBvh, lets_no_ray_escape_from_a_closed_room) {
  const Bvh bvh{build_scene(SceneSpec{}).mesh};
  Random random{3};
  for (int i = 0; i < 50000; ++i) {
    ASSERT_NE(bvh.cast({0.0F, 0.0F, 0.5F}, random_direction(random).cast<float>(), 100.0F).surface, kNoSurface);
  }
}

TEST(SimBvh, meets_walls_along_the_axes) {
  Mesh mesh;
  mesh.add_box({0.0, 0.0}, -1.0, {2.0, 4.0, 6.0}, 0.0);
  const Bvh bvh{mesh};
  const Eigen::Vector3f origin = Eigen::Vector3f::Zero();
  EXPECT_NEAR(bvh.cast(origin, {1, 0, 0}, 100).range_m, 1.0, 1e-6);
  EXPECT_NEAR(bvh.cast(origin, {0, -1, 0}, 100).range_m, 2.0, 1e-6);
  EXPECT_NEAR(bvh.cast(origin, {0, 0, 1}, 100).range_m, 5.0, 1e-6);
  EXPECT_NEAR(bvh.cast(origin, {0, 0, -1}, 100).range_m, 1.0, 1e-6);
}

TEST(SimBvh, sees_nothing_beyond_the_largest_range_or_in_an_empty_mesh) {
  Mesh mesh;
  mesh.add_box({0.0, 0.0}, -5.0, {10.0, 10.0, 10.0}, 0.0);
  EXPECT_EQ(Bvh{mesh}.cast({0, 0, 0}, {1, 0, 0}, 4.9F).surface, kNoSurface);
  EXPECT_EQ(Bvh{Mesh{}}.cast({0, 0, 0}, {1, 0, 0}, 100.0F).surface, kNoSurface);
}

TEST(SimBvh, copes_with_many_triangles_in_one_place) {
  Mesh mesh;
  for (int i = 0; i < 1000; ++i) mesh.add_horizontal(rectangle({0, 0}, {1, 1}, 0), 2.0);
  EXPECT_NEAR(Bvh{mesh}.cast({0, 0, 0}, {0, 0, 1}, 100.0F).range_m, 2.0, 1e-6);
}

}  // namespace
}  // namespace stairway::sim
